; Klartext runs. By hand: SQ 2 is 4, so Q1 is 5 * (2 + 4) = 30, and Q2 is 34. The arcs are a quarter counter-clockwise about 0, another, and a quarter
;    clockwise on the radius of 10. LBL 1 moves by 1 four times, LBL 9 skips X999, and Q5 is what is known beside the text.
; run:
; set: Q5=4
; is: klartext mm
; moves: 3 rapid 0 0 50 | 5 feed 20 0 50 | 6 feed 0 20 50 | 7 feed -20 0 50 | 8 feed 0 10 50 | 9 feed 10 0 50 | 12 feed 10 0 -34 | 14 rapid 11 0 -34
;    | 14 rapid 12 0 -34 | 14 rapid 13 0 -34 | 14 rapid 14 0 -34 | 23 feed 14 -1.5 -34 | 20 feed 14 -1.5 -30
; arcs: 6 0 0 50 turn 90 G17 | 7 0 0 50 turn 90 G17 | 9 0 0 50 turn -90 G17
; run:
; asks: Q5
0 BEGIN PGM K MM
1 TOOL CALL 5 Z S1000
2 L X+0 Y+0 Z+50 R0 FMAX M3
3 CC X+0 Y+0
4 L X+20 F500
5 C X+0 Y+20 DR+
6 CR X-20 Y+0 R+20 DR+
7 LP PR+10 PA+90
8 CP IPA-90 DR-
9 Q1 = +5 * ( 2 + SQ 2 )
10 FN 1: Q2 = +Q1 + +4
11 L Z-Q2
12 LBL 1
13 L IX+1 F MAX
14 CALL LBL 1 REP 3
15 CALL LBL "SUB"
16 FN 9: IF +Q2 EQU +34 GOTO LBL 9
17 L X+999
18 LBL 9
19 L IZ+Q5
20 M30
21 LBL "SUB"
22 L Y-1,5
23 LBL 0
24 END PGM K MM
