; An LNC: // begins a comment, @ is a global variable, words lie in each other. By hand: touches meet half way, so X is 5 after the first one,
; 3 after the way back, and 8 where the second one ends; the write is 8 and a radius of 3.
; run: touch 0.5
; start: 0 0 20
; offsets: 0
; set: #1=54 #2=10
; moves: 9 probe 10 0 20 | 11 feed 3 0 20 | 13 probe 13 0 20 | 15 feed 6 0 20
; writes: 20 offset G54 X 11
; asks: none
// Probes in X
G21 G17 G94 M5
@104 = 100        // fast
#111 = @104
IF[#1 < 53 || #2 == #0] // not so
  ALARM["G54 TO G59"]
END_IF
G91
G31 P2 X[#2] F#111  // 10 mm
IF[R_SKIP[0,1] == 1]
  G01 X-[2.]
  FIX_CUT_OR_ON
  G31 P2 X[#2] F[@104/4]
  FIX_CUT_OR_OFF
  G01 X-[2.]
  #104 = R_SKIP[0,201]
  IF[#1 >= 60]
    #104 = 0
  ELSEIF[#1 == 54]
    W_G53G59_COOR[0,#1,1,#104+3]
  ELSE
    ALARM["NOT HERE"]
  END_IF
ELSE
  ALARM["NO PART"]
END_IF
G90
M99
