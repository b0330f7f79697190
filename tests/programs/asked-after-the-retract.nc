; A touch that is asked about after its retract, and a move that ends in an alarm where it met something. By hand.
; run: touch 0.5
; post: fanuc
; broken: none
G21 G17 G90 G94
M5
G31 Z-5. F600
IF[#5003GT[-5.+0.001]]GOTO 9
G31 X-20. F60
#12=#5061-#500
G1 X-5. F600
IF[ABS[#12+15.]GE#501]GOTO 9
G1 Z20.
M30
N9 #3000=1 (MISSED)
M30
