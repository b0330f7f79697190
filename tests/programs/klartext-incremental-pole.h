; An incremental pole counts from where the tool stands, not from the pole before (HEIDENHAIN, Klartext programming, CC). By hand: from X10 the pole
; IX+5 is X15, and half a circle about it ends at X20.
; read:
; moves: 3 rapid 10 0 0 | 5 feed 20 0 0 | 6 feed 15 5 0
; arcs: 5 15 0 0 turn 180 G17
0 BEGIN PGM K MM
1 CC X+0 Y+0
2 L X+10 Y+0 Z+0 FMAX
3 CC IX+5 IY+0
4 C X+20 Y+0 DR+ F100
5 LP PR+5 PA+90
6 END PGM K MM
