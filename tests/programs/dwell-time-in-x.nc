; The X of a dwell is its time and no place.
; read:
; moves: 2 rapid 1 ? ?
G21
G0 X1
G4 X2.
