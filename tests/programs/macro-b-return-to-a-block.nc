; M99 P30 returns to N30 of the caller: X9 is skipped.
; read:
; moves: 3 rapid 0 0 0 | 9 feed 4 0 0 | 6 feed 4 1 0
O1
G21 G90
G0 X0. Y0. Z0.
G65 P9300 A4.
G1 X9. F9.
N30 G1 Y1. F9.
M30
O9300
G1 X#1 F9.
M99 P30
