; A check that leads to an alarm is not taken where its condition is not known: the program is the other way. By hand.
; run: touch 0.5
; start: 0 0 100
; moves: 4 feed 7 0 100 | 8 feed 7 5 100 | 6 rapid 7 5 100
; finding: branch-ends
; asks: Q20
BEGIN PGM CHECK MM
FN 0: Q1 = +7
FN 11: IF +Q20 GT +2 GOTO LBL "STOP"
L X+Q1 R0 F500
CALL LBL 2
L Z+100 R0 FMAX M30
LBL 2
L Y+5
LBL 0
LBL "STOP"
FN 14: ERROR = 1000
END PGM CHECK MM
