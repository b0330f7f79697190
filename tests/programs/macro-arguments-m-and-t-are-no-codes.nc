; M and T behind G65 are arguments: a tolerance of the position and a tool offset. M2. ends no program. By hand: every line is followed.
; read:
; lines: 2 4 6
; last: 6 rapid ? ? 50
; no finding: lines-skipped "below the end"
G21 G17 G90
G65 P9810 Z10. F2000.
G65 P9814 D25. Q2. M2.
G0 Z40.
G65 P9814 D25. Q2. T30. M30.
G0 Z50.
M30
