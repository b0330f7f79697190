; Of one value ATAN gives the angle of a slope. Above 0 all controls agree: the angle of 3/4 is 36.8699 degrees, and twice that of 1 is 90. Below 0 they do not.
; run:
; moves: 5 feed 36.8699 90 ?
O1
G21 G90
#1=ATAN[3/4]
#2=ATAN[1.]*2
G1 X#1 Y#2 Z[ATAN[0-1]] F9.
M30
