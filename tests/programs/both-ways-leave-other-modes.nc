; Where an unknown condition decides between G90 and G91, positions are not known until one of them is stated; between two motions, until one is named.
; run: touch 0.5
; post: fanuc
; moves: 4 feed 10 0 0 | 7 feed ? 0 0 | 9 feed 5 0 0 | 12 feed 5 ? 0 | 13 feed 5 8 0
; start: 0 0 0
; rules: none
G21 G17 G90 G94
M5
F100
G1 X10.
IF[#1EQ1]GOTO 10
G91
N10 X5.
G90
X5.
IF[#2EQ1]GOTO 20
G0
N20 Y7.
G1 Y8.
M30
