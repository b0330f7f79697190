; `iterations` is that of the innermost loop, begins at 0 each time, and is not known where the rounds are not. By hand.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; moves: 3 feed 0 0 20 | 5 feed 0 0 20 | 5 feed 0 1 20 | 3 feed 1 1 20 | 5 feed 1 0 20 | 5 feed 1 1 20 | 9 feed 5 1 20 | 10 feed ? ? 20
; asks: global.foo
G1 F100
while iterations < 2
  G1 X{iterations}
  while iterations < 2
    G1 Y{iterations}
while iterations < 3
  if global.foo > 2
    break
  G1 X{iterations*10+5}
G1 Z20
