; A call of another file is listed in its own line there.
; The touch there is not asked for a miss and states no feed. The rules that it breaks name no line of the program.
; file: O50.nc
; run: touch 0.5 positioning never
; calls: O50.nc:3 G65 P9814: hole or boss, four touches
; broken: missed-touch-stops@none feeds-stated@none
G21 G17 G90
M5
G65 P50
M30
