; A jump back makes three rounds: #100 is 0, 1 and 2, and at 3 the program leaves by N20. By hand.
; read:
; moves: 3 rapid 0 0 0 | 6 feed 0 0 0 | 6 feed 10 0 0 | 6 feed 20 0 0 | 9 feed 20 5 0
; findings: no-units
O1
G90 G17
G0 X0. Y0. Z0.
#100=0.
N10 IF[#100 GE 3.]GOTO 20
G1 X[#100*10.] F100.
#100=#100+1.
GOTO 10
N20 G1 Y5.
M30
