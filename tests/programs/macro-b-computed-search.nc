; Macro B computes. By hand: 30 / 2 - 2 + 3.5 = 16.5.
; read:
; moves: 7 rapid 0 0 -5 | 8 probe 16.5 0 -5 | 9 rapid 0 0 -5 | 10 probe -16.5 0 -5 | 11 rapid 0 0 -5
; findings: none
%
O2201(BORE)
#101=30.(DIAMETER)
#102=2.
#103=#101/2.-#102+3.5
G21 G90 G17
G0 X0 Y0 Z-5.
G31 X#103 F150.
G0 X0
G31 X-#103 F150.
G0 X0
M30
%
