; A fast touch, a way back, and a slow touch in the same direction: nothing asks about the first, and nothing need. By hand.
; run: touch 0.5
; post: fanuc
; broken: none
G21 G17 G90 G94
M5
G91 G31 Z-5. F600
G1 Z1. F600
G31 Z-2. F60
#1=#5063
IF[ABS[#1-#2]GT0.5]GOTO9
G90 G1 Z20.
M30
N9 #3000=1 (MISSED)
M30
