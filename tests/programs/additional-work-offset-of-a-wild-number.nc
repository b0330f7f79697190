; No control has a G54.1 P999999999999: the offset is another one than P1, and that is said.
; read:
; findings: places-transformed
G21
G54.1 P1
G0 X1
G54.1 P999999999999
X2
