; The second I is #7, the second K #9, the third J #11.
; start: 0 0 0
; run: touch 0.5 positioning never
; last: 7 rapid 3 5 4
%
O1
G21 G90
G65 P200 I1. I3. J2. J6. J5. K9. K4.
M30
O200
G0 X#7 Y#11 Z#9
M99
%
