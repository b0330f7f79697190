; A jump that is not known may skip the first M30: the touch at N10 is read, and the one below the second M30 is not.
; read:
; probes: 1
; moves: 6 probe 4 ? ?
G21
IF [#1 EQ 2] GOTO 10
(a comment)
M30
N10
G31 X4. F100.
M30
N20
G31 X5. F100.
