; RepRapFirmware: a code that is a file runs it, and M98 by its name; arguments are those of the call. By hand. Both loops end with their text.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; file: G6550.g
; moves: G6550.g:4 feed 7 0 20 | G6550.g:4 feed 8 0 20 | 3 rapid 8 3 20 | G6550.g:6 feed 8 3 9 | G6550.g:6 feed 8 3 8 | 6 rapid 0 3 8 | 6 rapid 1 3 8
; asks: none
var n = 3
G6550 X{var.n + 4}
G0 Y{var.n}
M98 P"g6550.g" Z9
while iterations < 2
  G0 X{iterations}
