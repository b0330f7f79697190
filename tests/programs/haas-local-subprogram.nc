; M97 P50 L2 runs the blocks from N50 twice. By hand: 1 + 4 + 4 = 9.
; read:
; line 4: rapid 9 2 9
; findings: none
G21 G90
G0 X1 Y2 Z3
M97 P50 L2
G0 Z9
M30
N50 G91 G1 X4. F50.
N51 G90 M99
%
