; A slash may stand behind the block number, with and without a blank: the touches are read.
; read:
; probes: 2
; moves: 2 probe 5 ? ? | 3 probe 5 5 ?
G21
N10 /G31 X5. F100.
N20/G31 Y5. F100.
