; An argument that was given is not vacant: the jump over Z-5 is made.
; import:
; moves: 2 rapid 0 0 5 | 6 unchecked 0 0 1
#1=5.
G0 X0. Y0. Z5.
IF [#1 NE #0] GOTO 10
G1 Z-5. F100.
N10
G31 Z1. F100.
M30
