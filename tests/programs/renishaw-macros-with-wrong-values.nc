; The same numbers as Renishaw has them: P9817 is a fourth axis, and P9814 is a hole. Values that no control takes are said.
; run:
; calls: 2 G65 P9817: fourth axis by two touches along X or Y
;    | 3 G65 P9814: hole or boss, four touches; D is -3: more than 0 is possible; F is 2: 0 to 1 is possible
G21 G90 G0 X0. Y0. Z5.
G65 P9817 X30. Z5.
G65 P9814 D-3. F2.
M30
