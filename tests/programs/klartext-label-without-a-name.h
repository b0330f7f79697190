; LBL and CALL LBL without a name end in nothing: the text comes back.
; run: touch 0.5 positioning never
; count: 1
; finding: lines-skipped "not understood" in line 4
0 BEGIN PGM A MM
1 L X+5 FMAX
2 LBL
3 CALL LBL
4 END PGM A MM
