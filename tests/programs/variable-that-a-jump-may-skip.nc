; A jump that may be made up to N10 may skip #101=6: it may be 5 or 6 there.
; read:
; line 7: feed ? 0 0
; line 9: feed 8 0 0
O1
G21 G90
G0 X0. Y0. Z0.
#101=5.
IF[#5061 GT 3.]GOTO 10
#101=6.
N10 G1 X#101 F100.
#101=8.
G1 X#101
M30
