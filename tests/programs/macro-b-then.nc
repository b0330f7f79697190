; A THEN whose condition holds is carried out, and one whose condition does not hold is not. By hand: #102 is 7.5.
; read:
; moves: 3 rapid 0 0 0 | 7 feed 7.5 -8.5 0
; findings: no-units
O2
G90 G17
G0 X0. Y0. Z0.
#101=2.
IF[#101 EQ 2.]THEN #102=7.5
IF[#101 EQ 3.]THEN #102=9.
G1 X#102 Y-[#102+1.] F100.
M30
