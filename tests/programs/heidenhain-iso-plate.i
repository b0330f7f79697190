; The ISO of a HEIDENHAIN ends its blocks with a star. The corners of its blank are no moves and no touches, and the pole of a circle in line 9 is no move.
; The circle about a pole is not solved. G41 compensates the radius, which is said. G54 is the datum shift: what was X20 is X10 from there on.
; read:
; is: iso mm
; moves: 5 rapid ? ? 50 | 6 rapid -20 7 50 | 7 feed -20 7 -3 | 8 feed 5 7 -3 | 10 feed 20 35 -3 | 12 rapid 10 35 100
; findings: places-transformed arc-unsolved
%PLATE G71 *
N10 G30 G17 X+0 Y+0 Z-20 *
N20 G31 G90 X+100 Y+80 Z+0 *
N30 T5 G17 S2500 *
N40 G00 G40 G90 Z+50 M3 *
N50 X-20 Y+7 *
N60 G01 Z-3 F200 *
N70 G41 X+5 *
N80 I+20 J+20 *
N90 G03 X+20 Y+35 *
N100 G54 X+10 *
N110 G00 Z+100 M2 *
N99999 %PLATE G71 *
