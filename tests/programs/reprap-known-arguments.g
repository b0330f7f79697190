; An argument that is given exists, and the others do not. By hand. The last loop ends with the text.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; set: param.A=7
; moves: 2 feed 7 0 20 | 5 feed 7 0 9 | 7 feed 0 1 9 | 7 feed 1 2 9
; asks: none
if exists(param.A) && !exists(param.B)
  G1 X{param.A} F100
elif exists(param.B)
  G1 X0
G1 Z{max(param.A, 9)}
while iterations < 2
  G1 X{iterations} Y{iterations + 1}
