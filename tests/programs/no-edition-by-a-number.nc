; A block number, a variable, a program number and a comment are no call of a macro: the program is for no edition, so S may stand beside H, and T beside M.
; read:
; calls: 6 G65 P9814: hole or boss, four touches | 7 G65 P9812: web or slot
O9817 (K)
(NOT FOR EDITION A-4013-0113)
G21 G90
N9801 G2 X20. Y0. I5. K0.
IF [#9817 LT 5] GOTO 9818 (DEK)
G65 P9814 D25. H0.05 S1.
G65 P9812 X30. T12. M0.1
M30
