// A is #1, B is #2
IF[#2 > 5]
  G91 G01 X-[#1] F500
  G90
END_IF
M99
