; The same by a jump back: behind it the program goes on, and what is set there is known. By hand.
; run:
; start: 0 0 0
; post: fanuc
; moves: 3 feed 0 0 0 | 6 feed ? 5 0 | 8 feed ? 7 0
; asks: #105
G21 G90
#101=0
N5 G1 X#101 F100
#101=#101+10
IF[#105 GT 3]GOTO5
G1 Y5
#103=7
G1 Y#103
M30
