; A loop that ends with the text, around a condition that is not known: it runs its three rounds, and both ways meet in each. By hand.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; moves: 3 feed 0 0 20 | 5 feed 0 5 20 | 3 feed 1 ? 20 | 5 feed 1 5 20 | 3 feed 2 ? 20 | 5 feed 2 5 20
; asks: global.foo
G1 F100
while iterations < 3
  G1 X{iterations}
  if global.foo > 2
    G1 Y5
