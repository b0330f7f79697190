; A refusal names the control of the text and the whole line of a loop.
; import:
; moves: refused
; findings: not-understood
; finding: not-understood "Fanuc"
; finding: not-understood ""WHILE [#1 LT 3] DO1""
G21
WHILE [#1 LT 3] DO1
G31 Z-5. F10.
END1
M30
