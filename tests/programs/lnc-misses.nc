; An LNC that finds nothing stops by its alarm: what is below is not known. By hand.
; run: touch never
; start: 0 0 20
; moves: 2 probe 0 0 10 | 4 rapid 0 0 20
; finding: program-stops in line 6
G90
G31 P2 Z10. F100
IF[R_SKIP[0,1] == 0]
  G0 Z20.
  #1 = 1
  ALARM["NO PART"]
END_IF
G0 Z0
M99
