; A call of a macro that stands on the control is named. P9810 goes where it says. Where P9811 ends is not known, until P9810 says a height.
; read:
; line 5: feed 14.5 -30 -8
; line 6: none
; line 7: feed ? ? 25
; finding: lines-skipped "P9811"
G21 G90 G17
T20 M6
G54 G0 X14.5 Y-30.
G43 H20 Z25.
G65 P9810 Z-8. F2500.
G65 P9811 Y-21. S1.
G65 P9810 Z25.
M30
