; M30 in a subprogram is the end of the program: X2 is not reached.
; read:
; moves: 2 rapid 1 ? ? | 7 rapid 3 ? ?
G21 G90
G0 X1
M98 P5
G0 X2
M30
O5
G0 X3
M30
