; G10 of a HEIDENHAIN is a rapid to a polar place, which is unknown. G70 states inch.
; read:
; is: iso inch
; line 4: rapid ? 2 ?
; finding: lines-skipped "G10 "
%A G70 *
N10 G00 G90 X1 *
N20 G10 R5 H30 *
N30 Y2 *
