; Two rounds of DO2 within each of two rounds of DO1. By hand.
; read:
; moves: 3 rapid 0 0 0 | 8 feed 1 1 0 | 8 feed 1 2 0 | 8 feed 2 1 0 | 8 feed 2 2 0 | 13 feed 2 2 1
O1
G21 G90
G0 X0. Y0. Z0.
#101=1.
WHILE[#101 LE 2.]DO1
#102=1.
WHILE[#102 LE 2.]DO2
G1 X#101 Y#102 F9.
#102=#102+1.
END2
#101=#101+1.
END1
G1 Z1.
M30
