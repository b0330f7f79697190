; Cycle 427 touches a wall towards X minus. By hand: 7 + 3 = 10.
; run:
; contacts: 10 -12 -3
; A wall that is not there stops the program.
; run: touch never
; count: 4
; finding: macro-stops
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
TCH PROBE 427 Q263=+7 Q264=-12 Q261=-3 Q320=4 Q272=1 Q267=-1 Q260=+20
L X+1 R0 FMAX
END PGM T MM
