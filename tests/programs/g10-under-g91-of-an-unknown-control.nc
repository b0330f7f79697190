; Whether G91 adds to the offset depends on the control: where that is not known, X is not. A Fanuc adds: X5 is 2 in a system 3 farther on.
; start: 0 0 0
; offsets: 0
; run: touch 0.5 positioning never
; last: 4 rapid ? 1 0
; run: touch 0.5 positioning never
; post: fanuc
; last: 4 rapid 2 1 0
G21 G90 G54
G0 X5.
G91 G10 L2 P1 X3.
G91 G0 Y1.
