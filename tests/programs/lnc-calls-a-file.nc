; An LNC calls a file by its name, and letters are #1, #2 and so on. By hand: half way of 20 is 10, and 3 back is 7.
; run: touch 0.5
; start: 0 0 20
; file: STEPBACK.nc
; moves: 2 probe 20 0 20 | STEPBACK.nc:3 feed 7 0 20 | 4 feed 7 1 20
; asks: none
G90
G31 X20. F100
G65 "STEPBACK" A3. B6.
G01 Y1. F100
M30
