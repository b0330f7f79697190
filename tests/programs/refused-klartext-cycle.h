; Of a Klartext program without a cycle that is a job here, no other control is named.
; import:
; moves: refused
; no finding: not-understood "read as a program for"
0 BEGIN PGM A MM
1 L X+5 FMAX
2 TCH PROBE 417 Q263=+7
3 END PGM A MM
