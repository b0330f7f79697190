; A subprogram that is not in the text may set G90, and a macro writes only if it is given a tool: neither is known. By hand.
; run: touch 0.5
; post: fanuc
; rules: offset-after-touches: not known | one-write: not known | plausible-before-write: not known | modes-left: not known
; broken: none
G21 G17 G90 G94
M5
G91 G31 Z-5. F600
#1=#5063
IF[ABS[#1-#2]GT0.5]GOTO9
G65 P9811 X5. T#20
M98 P100
M30
N9 #3000=1 (MISSED)
M30
