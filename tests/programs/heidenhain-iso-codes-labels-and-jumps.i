; The ISO of a HEIDENHAIN: D codes, formulas, labels, calls, repeats and jumps. By hand: Q2 is 30, and Q3 is 30 - 16 + 4 = 18. The section runs three times.
; run:
; set: Q9=5
; moves: 2 rapid 0 0 20 | 19 feed 0 30 20 | 8 feed 18 30 20 | 8 feed 36 30 20 | 8 feed 54 30 20 | 11 feed 54 50 20 | 16 feed 54 50 -12
; run:
; set: Q9=50
; moves: 2 rapid 0 0 20 | 19 feed 0 30 20 | 8 feed 18 30 20 | 8 feed 36 30 20 | 8 feed 54 30 20 | 16 feed 54 30 -12
; A jump ahead that is not known leaves Y open, and no parameter: D11 compares 12 with 5 either way.
; run:
; asks: Q9
; moves: 2 rapid 0 0 20 | 19 feed 0 30 20 | 8 feed 18 30 20 | 8 feed 36 30 20 | 8 feed 54 30 20 | 11 feed 54 50 20 | 16 feed 54 ? -12
%HOLES G71 *
N10 G00 G40 G90 X+0 Y+0 Z+20 *
N20 D00 Q1 P01 +12 *
N30 D03 Q2 P01 +Q1 P02 +2,5 *
N40 Q3 = Q2 - SQ 4 + Q1 / 3 *
N50 L1,0 *
N60 G98 L5 *
N70 G91 G01 X+Q3 F500 *
N80 L5,2 *
N90 D12 P01 +Q1 P02 +Q9 P03 7 *
N100 G90 Y+50 *
N110 G98 L7 *
N120 D11 P01 +Q1 P02 +5 P03 8 *
N130 X+999 *
N140 G98 L8 *
N150 G90 Z-Q1 *
N160 M30 *
N170 G98 L1 *
N180 G01 Y+Q2 *
N190 G98 L0 *
N99999 %HOLES G71 *
