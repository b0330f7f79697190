; Cycle 7 shifts from the preset, IX from the active shift. M91 goes to a place of the machine that is not known without the tool.
; start: 0 0 0
; run: touch 0.5 positioning never
; moves: 4 rapid 0 0 0 | 7 rapid 0 0 0 | 8 rapid ? 0 0
; systems: 4 10 0 0 | 7 15 0 0
0 BEGIN PGM A MM
1 CYCL DEF 7.0 DATUM SHIFT
2 CYCL DEF 7.1 X+10
3 L X+0 FMAX
4 CYCL DEF 7.0 DATUM SHIFT
5 CYCL DEF 7.1 IX+5
6 L X+0 FMAX
7 L X+0 M91 FMAX
8 END PGM A MM
