; A number after the first percent sign is the program's, and the program is read.
; read:
; moves: 3 rapid 1 ? ? | 4 rapid 2 ? ?
; findings: none
%100
G21
G0 X1
X2
%
