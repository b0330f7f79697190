; A move in two axes from whose end the program goes on positions the stylus: that a contact goes unnoticed is what is wrong with it. By hand.
; run: touch 0.5
; post: fanuc
; broken: positioning-watched@3
G21 G17 G90 G94
M5
G31 X-10. Y-5. F1500
#105=#5041
G31 Z-10. F50
IF[ABS[#5063+10.]LE0.05]GOTO 9
G1 Z5.
M30
N9 #3000=1 (MISSED)
