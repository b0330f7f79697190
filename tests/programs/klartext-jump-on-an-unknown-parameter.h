; The program may jump over the move along X, or not. By hand: where it is made X is 5, and behind the label it is not known.
; run:
; moves: 4 feed 5 ? ? | 6 feed ? 2 ?
BEGIN PGM A MM
Q1 = 5
FN 11: IF +Q9 GT +0 GOTO LBL 7
L X+Q1 F100
LBL 7
L Y+2
END PGM A MM
