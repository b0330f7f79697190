; Half way from 6 to -30 the contact is at -12: P1.5 calls it 1.5, so Z2 is 0.5 above it. Elsewhere P is named, and the control is asked for.
; start: 0 0 6
; run: touch 0.5 positioning never
; post: fluidnc
; writes: 2 offset G54 Z 1.5
; contacts: 0 0 -12
; last: 3 rapid 0 0 2
; systems: 3 0 0 -13.5
; run: touch 0.5 positioning never
; post: linuxcnc
; writes: none
; finding: probe-word in line 2
G21 G90 G54
G38.2 Z-30 F50 P1.5
G0 Z2
