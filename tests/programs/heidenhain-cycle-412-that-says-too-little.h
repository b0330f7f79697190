; A cycle that says too little to be known makes no move, and where it ends is not known.
; run:
; moves: 2 rapid 0 0 50 | 4 rapid 1 ? ?
BEGIN PGM T MM
L X+0 Y+0 Z+50 R0 FMAX
TCH PROBE 412 Q321=+5
L X+1 R0 FMAX
END PGM T MM
