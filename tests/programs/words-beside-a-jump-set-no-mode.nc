; Nothing stays of a line that is not followed: neither G0 nor G91 beside the jump applies to X5.
; read:
; kinds: feed feed
; last: 4 feed 5 ? ?
G21 G90
G1 X1 F1000
G0 G91 GOTO 5
X5
