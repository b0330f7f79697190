; A cycle leaves its results in Q151 to Q153, and functions and moves use them. The hole lies 0.5 off along X and -0.4 along Y. By hand: X is 0.5 + 10.
; run:
; part: { "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "hole", "diameter": 40, "depth": 20 }, "part": { "offset": [0.5, -0.4, 0] } }
; last: 16 rapid 10.5 -0.4 40
; no finding: value-unknown
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
FN 0: Q5 = -10
TCH PROBE 421 MEASURE HOLE ~
 Q273=+0 ~
 Q274=+0 ~
 Q262=+40 ~
 Q325=+0 ~
 Q247=+90 ~
 Q261=+Q5 ~
 Q320=+5 ~
 Q260=+20 ~
 Q301=+0
FN 1: Q1 = +Q151 + +10
FN 12: IF +Q153 LT +39.9 GOTO LBL 9
L X+Q1 Y+Q152 Z+Q153 R0 FMAX
LBL 9
END PGM T MM
