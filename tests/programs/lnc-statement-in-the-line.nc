; A statement behind THEN is that of its line alone. By hand.
; run: touch 0.5
; post: lnc
; start: 0 0 0
; moves: 5 feed 5 0 0 | 7 feed 5 1 0
#1=1
#2=0
IF [#1 EQ 1] THEN #2=5 // and no END_IF
IF [#1 > 5] THEN #2=7
G1 X#2 F100
IF [#1 == 1] THEN
  G1 Y1
END_IF
