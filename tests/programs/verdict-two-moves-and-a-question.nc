; The program asks after the second of two moves in one direction, and after a retract by the position of the contact itself. By hand.
; run: touch 0.5
; post: fanuc
; broken: none
G21 G17 G90 G94
M5
G31 Z20. F650
G31 Z15. F300
IF[#5003GT15.01]GOTO 9
G31 Z-5. F50
#25=#5063+1.
G1 Z#25 F1000
#30=122
IF[ABS[#5063+5.]LE0.05]GOTO 9
G1 Z50.
M30
N9 #3000=#30 (MISSED)
