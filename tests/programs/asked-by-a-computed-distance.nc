; A touch whose way is computed and then asked about, many lines below. By hand.
; run: touch 0.5
; post: fanuc
; broken: none
G21 G17 G90 G94
M5
#24=-5.
G31 Z#24 F60
#3004=0
#149=0
#4=#5063-#24
#5=#4*#4
#6=SQRT[#5]
#30=1
#31=2
IF[#6LT0.01]GOTO9
G1 Z20. F500
M30
N9 #3000=1 (MISSED)
M30
