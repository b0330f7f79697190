; Behind a jump comes a macro that is not in this text: whether it asks for a contact is not known.
; run: touch 0.5
; post: fanuc
; rules: positioning-watched: not known | missed-touch-stops: not known | offset-after-touches: not known | one-write: not known | plausible-before-write: not known
G21 G17 G90 G94
M5
G31 X-10. F1500
GOTO 5
N3 G31 Y-10. F1500
N5 G65 P5000
G31 X10. F1500
GOTO 7
N7 G65 P5000
M30
