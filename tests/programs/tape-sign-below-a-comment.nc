; A comment may stand above the first percent sign, which still begins the program.
; read:
; moves: 4 rapid 1 ? ?
; findings: none
(a comment)
%
G21
G0 X1
M30
%
