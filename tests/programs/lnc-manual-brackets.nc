; An LNC with the brackets of its manual, and FOR. By hand: the touch meets half way at X10, also where G54 is written after it.
; run: touch 0.5
; start: 0 0 20
; offsets: 0
; moves: 2 probe 20 0 20 | 4 feed 12 0 20 | 11 feed 1 0 20 | 11 feed 2 0 20 | 16 feed 2 9 20
; writes: 9 offset G54 X 10
; asks: none
G90
G31 X20. F100
IF[R_SKIP(0,1) == 1]
  G1 X12.
ELSE
  ALARM("NO PART")
END_IF
#104=R_SKIP(0,201)
W_G53G59_COOR(0,54,1,#104)
FOR #100=1 TO 7
  G1 X[#100-10+R_SKIP(0,201)]
  IF[#100 >= 2]
    EXIT_FOR
  END_IF
END_FOR
G1 Y9.
M30
