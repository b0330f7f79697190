; Both ways of a jump that is not known: behind the label X is 0 or 50. By hand.
; run:
; moves: 2 rapid 0 0 20 | 4 rapid 50 0 20 | 6 rapid ? 5 20
BEGIN PGM T MM
L X+0 Y+0 Z+20 R0 FMAX
FN 9: IF +Q1 EQU +Q2 GOTO LBL 5
L X+50 R0 FMAX
LBL 5
L Y+5 R0 FMAX
END PGM T MM
