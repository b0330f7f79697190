; P98 and P99 skip by torque on a Fanuc: the axis moves.
; start: 0 0 9
; run: touch 0.5 positioning never
; moves: 2 probe 0 0 -5
G21 G90 G54
G31 P99 Z-5. F50.
