; A THEN may jump, and a loop that is left by a jump is over: DO1 begins again below. By hand: X1 in the first round, then Y10 and Y11.
; read:
; moves: 3 rapid 0 0 0 | 8 feed 1 0 0 | 12 feed 1 10 0 | 12 feed 1 11 0 | 15 feed 1 11 1
O1
G21 G90
G0 X0. Y0. Z0.
#101=0.
WHILE[#101 LT 5.]DO1
#101=#101+1.
IF[#101 EQ 2.]THEN GOTO 50
G1 X#101 F9.
END1
N50 #101=10.
WHILE[#101 LT 12.]DO1
G1 Y#101
#101=#101+1.
END1
G1 Z1.
M30
