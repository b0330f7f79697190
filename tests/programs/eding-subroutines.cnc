; Eding CNC: subroutines by name, conditions and loops that lie in each other. By hand: both touches meets half way and goes back.
; run: touch 0.5
; start: 0 0 20
; offsets: 0
; moves: 7 rapid 0 0 5 | 8 probe 0 0 -5 | 12 rapid 0 0 20 | 7 rapid 10 0 5 | 8 probe 10 0 -5 | 12 rapid 10 0 20 | 24 rapid 0 0 20
; asks: none
Sub touch_down
  If [#5380 == 1] ; never while it runs
    msg "drawn"
  Endif
  warnmsg "down" #900
  G90
  G0 X#900 Z5
  G38.2 Z-5 F50
  If [#5067 <> 1]
    errmsg "nothing there"
  Else
    G0 Z20
  Endif
Endsub

#900 = 0
While [#900 <= 10]
  GoSub touch_down
  If [[#5063 < -0.1] or [#5063 > 0.1]]
    errmsg "too far"
  Endif
  #900 = [#900 + 10]
EndWhile
G0 X0
M30
