; A macro that is not there has locals of its own: #1 of the caller stays known, and #100 does not.
; start: 0 0 0
; run: touch 0.5 positioning never
; line 7: rapid 4 0 ?
; last: 8 probe 0 0 ?
%
O1
G21 G90
#1=4.
#100=3.
G65 P9999 A1.
G0 X#1 Y0. Z#100
G31 X0. F9.
M30
