; By L of a Fanuc: 10 a length, 11 and 13 a wear, 12 a radius; without L a tool all the same. LinuxCNC writes a length by L1 and Z, a radius by R.
; start: 0 0 9
; run: touch 0.5 positioning never
; post: fanuc
; writes: 3 length tool 4 ? 1 | 4 wear tool 4 ? 2 | 5 radius tool 4 ? 3 | 6 wear tool 4 ? 4 | 7 table tool 4 ? 5
; run: touch 0.5 positioning never
; post: linuxcnc
; last: 2 probe 0 0 1
G21 G90 G54
G31 Z1. F50.
G10 L10 P4 R1.
G10 L11 P4 R2.
G10 L12 P4 R3.
G10 L13 P4 R4.
G10 P4 R5.
M30
