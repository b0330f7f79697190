; With the tool axis at the machine's zero, ways across pass above every part. Below it they do not. By hand.
; run: touch 0.5
; post: fanuc
; offsets: 0
; broken: positioning-watched@8
G21 G17 G90 G94
M5
G53 G1 Z0 F2000
G53 G1 X-100. Y-50.
G54 G1 Y0
G31 Z-20. F50
IF[ABS[#5063+20.]LE0.05]GOTO 9
G1 X-90.
G91 G28 Z0
G90 G1 X50.
G31 Z-10. F50
IF[ABS[#5063+10.]LE0.05]GOTO 9
M30
N9 #3000=1 (MISSED)
