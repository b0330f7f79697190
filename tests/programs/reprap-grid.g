; RepRapFirmware: names, braces, structures by indentation. By hand: two touches in the first row, one in the second, each half way from Z5 to Z-5.
; run: touch 0.5
; post: reprapfirmware
; start: 0 0 20
; offsets: 0
; moves: 8 rapid 0 0 5 | 10 probe 0 0 -5 | 13 rapid 0 0 1 | 8 rapid 10 0 5 | 10 probe 10 0 -5 | 13 rapid 10 0 1 | 8 rapid 0 20 5 | 10 probe 0 20 -5 | 13 rapid 0 20 1 | 20 rapid 0 20 30
; asks: none
var step = 10
global safe = 30
var row = 0
while var.row < 2 ; rows
  while true
    if iterations = (var.row = 0 ? 2 : 1)
      break
    G0 X{iterations * var.step} Y{var.row * 2 * var.step} Z5
    ; a comment says nothing of indentation
    G38.2 Z{-5} F50
    if result != 0
      abort "no contact"
    G0 Z{move.axes[2].userPosition + 1}

  set var.row = var.row + 1
  if !(var.row > 5)
    continue
  G0 Z99

G0 Z{global.safe}
