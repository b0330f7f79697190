; A macro that restores the modes of its caller: which they are is its caller's affair. By hand.
; run: touch 0.5
; post: fanuc
; rules: modes-stated: not known | spindle-off: not known | offset-after-touches: not known | one-write: not known | plausible-before-write: not known | modes-left: not known
O9101 (HEIGHT)
#1=#4001
#2=#4003
G91 G31 Z-10. F50
IF[ABS[#5063+10.]LE0.05]GOTO 9
G0 Z5.
G#1 G#2 M99
N9 #3000=1 (MISSED)
