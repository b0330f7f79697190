; Lines below M30 are not followed, which is said once with their number.
; read:
; moves: 2 rapid 1 ? ?
; finding: lines-skipped "Lines below the end of the program, M2, M30, M99 or %, are not followed: 2 times, the first in line 4"
G21
G0 X1
M30
N9 G0 X2
X3
