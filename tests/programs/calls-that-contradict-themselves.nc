; Each call of a macro is named, and what contradicts in its arguments is said. P9810 makes its move.
; run:
; calls: 4 G65 P9812: web or slot; X and Y exclude each other | 5 G65 P9814: hole or boss, four touches; D is missing | 6 G65 P9810: protected positioning move
;    | 7 G65 P8811: single surface | 8 G65 P9999: not known
; line 6: feed 1 2 -8
%
O1
G21 G90 G0 X0. Y0. Z5.
G65 P9812 X30. Y20. Q5.
G65 P9814 Q3.
G65 P9810 X1. Y2. Z-8. F800.
G65 P8811 Z-10.
G65 P9999 A1.
M30
%
