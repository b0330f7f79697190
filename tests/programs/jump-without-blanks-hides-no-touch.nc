; The same without blanks: IF[#1EQ2]GOTO10.
; read:
; probes: 1
; moves: 4 probe 4 ? ?
G21
N5 IF[#1EQ2]GOTO10
N6 M30
N10 G31 X4. F100.
M30
