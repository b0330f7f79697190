; A Haas has variables from #10000: one of them is set, which costs the program none of its moves.
; import:
; moves: 2 rapid 0 0 5 | 3 unchecked 0 0 1
#10101=5.
G0 X0. Y0. Z5.
G31 Z1. F100.
M30
