; By the definition of G65, A is #1 and Z is #26. What is not given is vacant, and a word whose value is vacant is left out: Y stays at 2.
; After the macro #1 is the caller's 50 again.
; read:
; moves: 3 rapid 1 2 3 | 9 feed 10 2 -3 | 11 feed 10 4 -3 | 6 feed 50 4 -3
; findings: none
O1
G21 G90
G0 X1. Y2. Z3.
#1=50.
G65 P9100 A5. Z-3.
G1 X#1 F100.
M30
O9100
G1 X[#1*2.] Y#25 Z#26 F60.
IF[#7 EQ #0]THEN #7=4.
G1 Y#7
M99
