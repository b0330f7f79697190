; Mach3 keeps the last contact in #2000 to #2002 [R]. By hand: half way from Z10 to Z-10.
; run: touch 0.5
; post: mach3
; start: 3 4 10
; moves: 2 probe 3 4 -10 | 4 rapid 3 4 5
G21 G90
G31 Z-10 F100
#1=#2002
G0 Z[#1+5]
M30
