; G52 of a Fanuc shifts every work offset: X0 of G54 is machine 15, X0 of G55 machine 105, without the shift 100. G10 L2 adds under G91.
; start: 0 0 0
; offsets: 0
; run: touch 0.5 positioning never
; post: fanuc
; moves: 5 rapid 0 0 0 | 6 rapid 0 0 0 | 8 rapid 0 0 0 | 10 rapid 0 3 0
; systems: 5 15 0 0 | 6 105 0 0 | 8 100 0 0 | 10 107 0 0
G21 G90
G10 L2 P1 X10. (G54)
G10 L2 P2 X100. (G55)
G54 G52 X5.
G0 X0.
G55 G0 X0.
G52 X0.
G0 X0.
G91 G10 L2 P2 X7.
G90 G0 X0. Y3.
