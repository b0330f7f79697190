; P9814 runs from the nominal middle of a hole of 40 that lies 0.7 and -0.4 off. Renishaw's own macros, run the same way, touch it at these places.
; The macro touches each wall twice, 1.6 back from the first contact.
; run:
; part: { "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "hole", "origin": [0, 0, 10], "diameter": 40, "depth": 20 }, "part": { "offset": [0.7, -0.4, 0] } }
; contacts: 0 -17.3856 -5 | 0 -17.3856 -5 | 0 16.5856 -5 | 0 16.5856 -5 | -16.3 -0.4 -5 | -16.3 -0.4 -5 | 17.7 -0.4 -5 | 17.7 -0.4 -5
; line 4: probe 0 -25 -5 | feed 0 -15.7856 -5 | probe 0 -25 -5 | feed 0 0 -5 | probe 0 25 -5 | feed 0 14.9856 -5 | probe 0 25 -5 | feed 0 0 -5
;    | rapid 0 -0.4 -5 | probe -25 -0.4 -5 | feed -14.7 -0.4 -5 | probe -25 -0.4 -5 | feed 0 -0.4 -5 | probe 25 -0.4 -5 | feed 16.1 -0.4 -5 | probe 25 -0.4 -5
;    | feed 0 -0.4 -5 | rapid 0 0 -5
; last: 5 feed 0 0 50
; Without a part each touch ends where the call says the feature is: 20 - 3 = 17 from the middle.
; run:
; contacts: 0 -17 -5 | 0 -17 -5 | 0 17 -5 | 0 17 -5 | -17 0 -5 | -17 0 -5 | 17 0 -5 | 17 0 -5
; With nothing to meet the macro stops the program.
; run: touch never
; moves: 3 rapid 0 0 -5 | 4 probe 0 -25 -5
; finding: macro-stops
O1
G21 G17 G90
G0 X0. Y0. Z-5.
G65 P9814 D40. Q5.
G65 P9810 Z50. F900.
M30
