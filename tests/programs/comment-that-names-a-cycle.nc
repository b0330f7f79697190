; A comment may say anything: CYCLE in it makes no SINUMERIK of this program.
; read:
; is: iso mm
; moves: 5 rapid 1 1 1 | 6 probe 1 1 -5
%
O1 (A)
G21 G90
T1 M6 (PROBE CYCLE TEST)
G0 X1 Y1 Z1
G31 Z-5 F100
