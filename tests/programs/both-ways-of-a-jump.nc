; Both ways of a condition that is not known begin where they part: behind the jump X may still be 0. By hand.
; run: touch 0.5 positioning never
; moves: 2 rapid 0 0 20 | 4 rapid 50 0 20 | 5 rapid ? 5 20 | 6 rapid 1 5 20
; resumes: 5 ? 0 20
G21 G90
G0 X0 Y0 Z20
IF [#100 GT 5] GOTO 10
G0 X50 Y0
N10 G0 Y5
G0 X1
M30
