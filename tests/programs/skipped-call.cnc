; A call that block skip may leave out: what it sets, and where it goes, is not known. By hand.
; run: touch 0.5
; post: eding
; start: 0 0 0
; moves: 4 feed ? ? ? | 5 feed ? 1 ?
G90
#2=0
/GOSUB foo
G1 X#2 F100
G1 Y1
M30
SUB foo
#2=5
ENDSUB
