; Centroid: M115 and M116 probe, M125 and M126 are protected moves, L1 lets a touch miss. By hand: the second touch begins where the first one met.
; run: touch 0.5 positioning never
; start: 0 0 5
; moves: 4 probe 10 0 5 | 5 probe 20 0 5 | 6 probe 15 0 -5 | 8 rapid 15 0 5
; asks: none
G21 G17 G90 G94
M5
#101=20
M125 /X10 P15 F500
M115 /X[#101] P-15 F100 (stops without a contact)
M116 /Z-5 P15 F100 L1
IF [ABS[#5043 + 5] LE 0.01] THEN GOTO 100
G0 Z5
N100 M30
