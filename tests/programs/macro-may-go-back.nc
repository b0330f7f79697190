; A macro may go back early, or go on: its M99 ends no program, and behind the call the axis is where both ways agree. By hand.
; run: touch 0.5
; start: 0 0 20
; post: fanuc
; moves: 7 rapid 0 0 30 | 9 rapid 0 0 40 | 3 feed 5 0 ?
; asks: #500
O1
G65 P9
G1 X5 F100
M30
O9
IF[#500 EQ 1]GOTO 20
G0 Z30
M99
N20 G0 Z40
M99
