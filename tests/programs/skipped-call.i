; The same in the ISO of a HEIDENHAIN. By hand.
; run: touch 0.5
; moves: 3 rapid 0 0 20 | 5 feed ? ? ? | 6 feed ? 1 ?
%A G71 *
N10 D00 Q1 P01 +0 *
N15 G00 G40 G90 X+0 Y+0 Z+20 *
/N20 L1,0 *
N30 G01 X+Q1 F100 *
N35 G01 Y+1 *
N40 M30 *
N50 G98 L1 *
N60 D00 Q1 P01 +5 *
N70 G98 L0 *
N99999 %A G71 *
