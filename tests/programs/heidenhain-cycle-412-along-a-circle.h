; Cycle 412 makes its moves: a circle of 40 about (5, 6), 4 aside by a ball of 6. By hand: it begins at a radius of 20 - 3 - 4 = 13, the ball's centre makes contact at 17,
;    between touches it follows an arc of 90 degrees, and at the end it goes to the clearance height.
; run:
; moves: 2 rapid 0 0 50 | 3 rapid 18 6 50 | 3 rapid 18 6 -5 | 3 probe 32 6 -5 | 3 rapid 18 6 -5 | 3 feed 5 19 -5 | 3 probe 5 33 -5 | 3 rapid 5 19 -5
;    | 3 feed -8 6 -5 | 3 probe -22 6 -5 | 3 rapid -8 6 -5 | 3 feed 5 -7 -5 | 3 probe 5 -21 -5 | 3 rapid 5 -7 -5 | 3 rapid 5 -7 20 | 4 rapid 1 -7 20
; arcs: 3 5 6 -5 turn 90 G17 | 3 5 6 -5 turn 90 G17 | 3 5 6 -5 turn 90 G17
; contacts: 22 6 -5 | 5 23 -5 | -12 6 -5 | 5 -11 -5
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
TCH PROBE 412 DATUM INSIDE CIRCLE Q321=+5 Q322=+6 Q262=40 Q325=+0 Q247=+90 Q261=-5 Q320=4 Q260=+20 Q301=0
L X+1 R0 FMAX
END PGM T MM
