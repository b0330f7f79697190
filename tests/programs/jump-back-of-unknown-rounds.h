; The same in Klartext. By hand.
; run:
; start: 0 0 0
; moves: 4 feed 0 0 0 | 7 feed ? 5 0 | 9 feed ? 7 0
; asks: Q5
BEGIN PGM LOOP MM
Q1 = 0
LBL 5
L X+Q1 R0 F100
Q1 = Q1 + 10
FN 11: IF +Q5 GT +3 GOTO LBL 5
L Y+5
Q3 = 7
L Y+Q3
END PGM LOOP MM
