; What DPRNT prints is text: MEAS= and CR= in it make no SINUMERIK of this program.
; read:
; probes: 2
; moves: 2 probe 5 ? ? | 5 probe 5 5 ?
G21
G31 X5. F100.
DPRNT[MEAS=#5061[43]]
DPRNT[CR=#5061[43]]
G31 Y5. F100.
