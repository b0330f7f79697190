; P20100 runs O100 twice, behind the move of its own block. The moves stand in the lines of the subprogram.
; read:
; moves: 2 rapid 1 2 3 | 3 rapid 5 2 3 | 7 probe 5 7 3 | 7 probe 5 7 3 | 4 rapid 5 7 9
G21 G90
G0 X1 Y2 Z3
X5 M98 P20100
G0 Z9
M30
O100
G31 Y7. F50.
M99
%
