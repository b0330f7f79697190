; The same by M98: the first M99 counts for one of the two ways alone. By hand.
; run: touch 0.5
; start: 0 0 0
; post: fanuc
; moves: 7 feed 10 0 0 | 9 feed 20 0 0 | 3 feed ? 10 0
; asks: #500
O1
M98 P2
G1 Y10 F100
M30
O2
IF[#500 EQ 1]GOTO 20
G1 X10 F100
M99
N20 G1 X20 F100
M99
