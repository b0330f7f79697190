; G31.1, G31.3 and G31 P2 are probing moves of a Fanuc.
; read:
; moves: 2 rapid 0 0 9 | 3 probe 0 0 -1 | 4 probe 5 0 -1 | 5 probe 7 0 -1 | 6 rapid 7 0 9
G21 G90
G0 X0 Y0 Z9
G31.1 Z-1. F100.
G31.3 X5. F100.
G31 P2 X7. F100.
G0 Z9.
