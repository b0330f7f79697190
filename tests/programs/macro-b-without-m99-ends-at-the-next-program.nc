; A macro without M99 ends where the next program begins: Z9 of O9400 is not run.
; read:
; moves: 3 rapid 0 0 0 | 8 feed 4 0 0 | 5 feed 4 1 0
O1
G21 G90
G0 X0. Y0. Z0.
G65 P9300
G1 Y1. F9.
M30
O9300
G1 X4. F9.
O9400
G1 Z9. F9.
M99
