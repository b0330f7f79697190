; A jump that only skips some lines comes to the planned end, too: what it skips may not have run, and #100 is 1 or 2. By hand: Z from 9 to 0, met half way at 4.5.
; run: touch 0.5 positioning never
; moves: 4 rapid 0 0 9 | 9 probe 0 0 0 | 10 rapid ? 0 4.5
%
O1
G21 G90
G0 X0. Y0. Z9.
#100=1.
IF [#500 EQ 1] GOTO 20
#100=2.
N20
G31 Z0. F9.
G0 X#100
M30
