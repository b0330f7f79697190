; The F of a macro call is an argument of the macro: the feed is still 100.
; read:
; moves: 2 feed 1 ? ? F100 | 4 feed 2 ? ? F100
G21
G1 X1 F100
G65 P9811 X5. F300
G1 X2
