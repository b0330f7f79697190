; RepRapFirmware sets its probe by G31, and no control has a fifth skip signal: nothing moves.
; start: 0 0 20
; run: touch 0.5 positioning never
; moves: 3 rapid 5 0 20
; finding: lines-skipped "G31 moves nothing" in line 2
G21 G90
G31 P25 X0 Y21.5 Z1.42
G0 X5
