; A cycle of which the places are not known leaves the stylus somewhere. It is named, with its arguments and what they mean.
; run:
; is: klartext inch
; moves: 2 rapid 1 2 3 | 6 rapid ? ? 3 | 7 feed ? ? 3
; calls: 3 TCH PROBE 412: centre of a hole (inside circle) as datum
; argument Q262: 25 nominal diameter
; finding: lines-skipped "TCH PROBE 412"
BEGIN PGM A INCH
L X+1 Y+2 Z+3 FMAX
TCH PROBE 412 DATUM INSIDE CIRCLE ~
 Q321=+1 ;CENTER ~
 Q262=+25
L Z+3 FMAX
L X+Q151
END PGM A INCH
