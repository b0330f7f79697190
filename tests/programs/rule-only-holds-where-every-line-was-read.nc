; What a macro that is not here writes is not known: no rule on writes holds. The feed is stated above the touch.
; start: 0 0 9
; run: touch 0.5 positioning never
; rules: spindle-off: not known | offset-after-touches: not known | one-write: not known | plausible-before-write: not known
G21 G17 G90 F80
G31 Z2.
IF [#5063 LE 2.] GOTO 9
G65 P7777 A1.
M30
N9 #3000=1 (NO CONTACT)
