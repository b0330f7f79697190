; The number of a macro may be an expression: the call is named without one, and where it ends is not known.
; run:
; calls: 3 G65: not known
; last: 4 feed 1 ? ?
G21 G90
G0 X0 Y0 Z5
G65 P[#1+9800] X3.
G1 X1 F9
