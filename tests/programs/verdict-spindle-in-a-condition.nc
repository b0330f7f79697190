; A condition that is not known starts the spindle, for a tool that turns.
; run: touch 0.5
; post: fanuc
; rules: spindle-off: not known
G21 G17 G90 G94
M5
IF[#3NE1]GOTO 5
M4 S800
N5 G31 Z-10. F30
IF[ABS[#5063+10.]LE0.05]GOTO 9
M5
M30
N9 #3000=1 (MISSED)
