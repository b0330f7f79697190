; A macro leaves X, Y and the size in #135, #136 and #138 of a Fanuc, and #101 as it was. The hole lies 0.5 off along X and -0.4 along Y. By hand: X is 0.5 + 10, Z the diameter of 40.
; post: fanuc
; run:
; part: { "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "hole", "diameter": 40, "depth": 20 }, "part": { "offset": [0.5, -0.4, 0] } }
; start: 0 0 -10
; last: 5 rapid 10.5 -0.4 40
G21 G17 G90
#101=10.
G65 P9814 D40. Q5.
G65 P9810 Z30. F2000.
G0 X[#135+#101] Y#136 Z#138
M30
