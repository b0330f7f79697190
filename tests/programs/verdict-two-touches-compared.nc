; A first touch that misses is seen where the second one is compared with it. By hand.
; run: touch 0.5
; post: fanuc
; start: 0 0 0
; broken: none
G21 G17 G90 G94
M5
G31 Z-20. F500
#17=#5063
G91 G31 Z-5. F50
#18=ABS[#17-#5063]
IF[#18GT1.]GOTO 9
G90
M30
N9 #3000=1 (MISSED)
