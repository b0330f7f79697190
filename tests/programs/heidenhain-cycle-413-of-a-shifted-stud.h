; Cycle 413 touches a stud from outside, and Q301 = 1 lifts between the touches. The part lies 2 off along Y. By hand: the ball's centre is 23 from (0, 2) at each contact: Y25 and Y-21, and X22.9129 where Y is 0, the root of 23 * 23 - 2 * 2.
; run:
; part: { "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "boss", "origin": [0, 0, 5], "diameter": 40, "depth": 20 }, "part": { "offset": [0, 2, 0] } }
; line 3: rapid 0 27 50 | rapid 0 27 -5 | probe 0 13 -5 | rapid 0 27 -5 | rapid 0 27 20 | rapid -27 0 20 | rapid -27 0 -5
;    | probe -13 0 -5 | rapid -27 0 -5 | rapid -27 0 20 | rapid 0 -27 20 | rapid 0 -27 -5 | probe 0 -13 -5 | rapid 0 -27 -5 | rapid 0 -27 20
;    | rapid 27 0 20 | rapid 27 0 -5 | probe 13 0 -5 | rapid 27 0 -5 | rapid 27 0 20
; contacts: 0 25 -5 | -22.9129 0 -5 | 0 -21 -5 | 22.9129 0 -5
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
TCH PROBE 413 Q321=+0 Q322=+0 Q262=40 Q325=+90 Q247=+90 Q261=-5 Q320=4 Q260=+20 Q301=1
L X+1 R0 FMAX
END PGM T MM
