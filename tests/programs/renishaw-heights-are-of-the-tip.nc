; Heights of a program with Renishaw's macros are those of the stylus tip. By hand: a top side 0.3 above Z0 is measured at 0.3, whatever the ball.
; post: haas
; run:
; part: { "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "surface" }, "part": { "offset": [0, 0, 0.3] } }
; start: 0 0 20
; last: 4 rapid 0 0 20.3
G21 G17 G90
G65 P9810 Z10. F2000.
G65 P9811 Z0. Q5.
G0 Z[20.+#187]
M30
