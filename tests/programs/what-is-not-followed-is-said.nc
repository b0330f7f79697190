; What has to be computed or jumped to is passed over and said, and the rest of the program is read. By hand.
; The place of X is not known until the program gives a number again, nor is the place of Z in the work offset after a move in the machine's own system.
; read:
; moves: 3 rapid 1 2 3 | 6 feed ? 2 3 | 7 probe ? -5 3 | 8 feed 7 -5 3 | 9 rapid 7 -5 ?
; findings: lines-skipped lines-skipped lines-skipped places-computed machine-places
; finding: lines-skipped "The result of these conditions is unknown" in line 5
; finding: lines-skipped "These variables get an unknown value" in line 4
; finding: lines-skipped "The called program is not in this text" in line 10
O1000 (FANUC)
G21 G17
G0 X1. Y2. Z3.
#101=#5041
IF [#101 GT 3.] GOTO 20
G1 X#101 F100.
G31 Y-5. F50.
N20 X7.
G53 G0 Z0.
M98 P20
M30
%
