; Without Q a touch in the plane searches 5 mm: from X-20 for a wall at 9 to 14.
; start: -20 0 -5
; run: touch never
; last: 2 probe 14 0 -5
G21 G90
G65 P9811 X9.
M30
