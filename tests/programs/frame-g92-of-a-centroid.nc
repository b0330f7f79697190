; G92 shifts every system on most controls, on a Centroid the active one alone: G55 is at its own zero, machine 100, where others come to 110.
; start: 0 0 0
; offsets: 0
; run: touch 0.5 positioning never
; post: centroid
; systems: 5 10 0 0 | 6 100 0 0
; run: touch 0.5 positioning never
; post: fanuc
; systems: 5 10 0 0 | 6 110 0 0
G21 G90 G54
G10 L2 P2 X100.
G0 X10.
G92 X0.
G0 Y1.
G55 G0 X0.
