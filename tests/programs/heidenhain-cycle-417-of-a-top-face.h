; Cycle 417 touches a face from above. By hand: 2 + 3 + 4 = 9 above it, then 14 down.
; run:
; moves: 2 rapid 0 0 50 | 3 rapid 7 -12 50 | 3 rapid 7 -12 9 | 3 probe 7 -12 -5 | 3 rapid 7 -12 9 | 3 rapid 7 -12 20 | 4 rapid 1 -12 20
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
TCH PROBE 417 Q263=+7 Q264=-12 Q294=+2 Q320=4 Q260=+20
L X+1 R0 FMAX
END PGM T MM
