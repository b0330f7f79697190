; Without Q a touch in the plane searches 10 mm in the edition that the comment names: from X-20 for a wall at 9 to 19.
; start: -20 0 -5
; run: touch never
; last: 4 probe 19 0 -5
(RENISHAW INSPECTION PLUS A-4013-0113)
G21 G90
M5
G65 P9811 X9.
M30
