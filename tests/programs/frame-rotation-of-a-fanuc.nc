; G68 turns about its centre: X10 Y0 lies at 0, 10 beside the centre 0, 0; G69 ends it, and the stylus stands there.
; start: 0 0 0
; run: touch 0.5 positioning never
; moves: 3 rapid 10 0 0 | 5 rapid 0 10 5
; systems: 3 0 0 0 turned 90 | 5 0 0 0
G21 G90 G17
G68 X0. Y0. R90.
G0 X10. Y0.
G69
G0 Z5.
