; The contact of an Eding in machine coordinates stays where it was when the work offset is written. By hand: contact at 10, G54 moves by 10 - 2.
; run: touch 0.5
; start: 0 0 20
; offsets: 0
; moves: 3 probe 20 0 20 | 6 feed 12 0 20 | 7 feed 2 0 20
; asks: none
G90
#900=2
G38.2 X20 F50
G10 L2 P#5220 X[#5051-#900]
#901=[#5051+#900]
G1 X#901
G1 X#900
M30
Sub user_1
Endsub
