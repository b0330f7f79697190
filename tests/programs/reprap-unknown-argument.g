; Both ways of a condition that is not known are run, and meet below it. By hand: Z is 4 or 2 there, X is 1 either way.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; moves: 4 feed 1 0 4 | 6 feed 1 0 2 | 7 feed 3 0 ?
; resumes: 6 0 0 20 | 7 1 0 ?
; asks: param.A
G90
G1 F100
if exists(param.A)
  G1 X1 Z4
else
  G1 X1 Z2
G1 X3
