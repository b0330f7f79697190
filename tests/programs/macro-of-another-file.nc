; G65 runs a program of another file in its own lines. By hand: #26 is Z, #24 is X; half way from 20 to -2 is 9.
; file: O9701.nc
; run: touch 0.5
; moves: 4 rapid 0 0 20 | O9701.nc:3 probe 0 0 -2 | O9701.nc:6 feed 4 0 9 | O9701.nc:7 rapid 4 0 20 | 6 rapid 4 7 20
; Nothing is met: the macro stops the program.
; run: touch never
; moves: 4 rapid 0 0 20 | O9701.nc:3 probe 0 0 -2
; finding: program-stops "line 10 (O9701.nc)"
%
O1
G21 G90
G0 X0. Y0. Z20.
G65 P9701 X4. Z-2.
G0 Y7.
M30
%
