; A Haas says in the block itself what a contact is: M78 alarms at one, and M79 at a miss. Every rule of a run holds.
; start: 0 0 20
; run: touch 0.5 positioning never
; moves: 5 probe 5 5 20 | 6 probe 5 5 -5 | 7 feed 5 5 20
; rules: all hold
%
O1
G21 G17 G90
M5
G31 X5. Y5. F500. M78
G31 Z-5. F50. M79
G1 Z20. F500.
M30
%
