; A Centroid's macros have numbers of Renishaw's: P9813 is a slot, P9817 a hole, and A names the axis. A value that no control takes is said.
; read:
; calls: 2 G65 P9813: slot, or with C1 a rectangular pocket | 3 G65 P9817: hole, four touches | 4 G65 P9811: single surface; A is 4: 1 to 3 is possible
; run:
; calls: 2 G65 P9813: slot, or with C1 a rectangular pocket | 3 G65 P9817: hole, four touches | 4 G65 P9811: single surface; A is 4: 1 to 3 is possible
G21 G90 G0 X0. Y0. Z5.
G65 P9813 A1 X30. Q5.
G65 P9817 D25. Q5.
G65 P9811 A4 X3.
M30
