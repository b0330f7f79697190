; ROUND in an assignment rounds to a whole number. In a word a Fanuc rounds to the smallest step of the axis, whichever that is, so the place is not known.
; read:
; moves: 3 rapid 0 0 0 | 5 feed 1 0 0 | 6 feed 1 ? 0 | 7 probe 1 ? -1
O1
G21 G90
G0 X0. Y0. Z0.
#101=ROUND[1.4]
G1 X#101 F9.
G1 Y[ROUND[1.4]]
G31 Z-1.
M30
