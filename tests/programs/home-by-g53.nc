; A place of the machine's own system is none of the work offset: G53 makes no move here, and that is said.
; import:
; moves: 1 rapid 0 0 5 | 2 unchecked 0 0 1 | 4 rapid 9 0 7
; finding: machine-places
G0 X0. Y0. Z5.
G31 Z1. F100.
G53 G0 Z0.
G0 X9. Z7.
M30
