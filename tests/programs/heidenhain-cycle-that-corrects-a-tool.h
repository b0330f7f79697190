; Q330 names the tool whose DR a measuring cycle corrects; 0 is none.
; start: 0 0 20
; run:
; writes: 2 wear tool 12 ? ?
0 BEGIN PGM A MM
1 TCH PROBE 421 MEASURE HOLE ~
    Q273=+0 ~
    Q274=+0 ~
    Q262=+30 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+2 ~
    Q260=+20 ~
    Q301=+0 ~
    Q275=+30.1 ~
    Q276=+29.9 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+12
2 TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+0 ~
    Q264=+30 ~
    Q261=+0 ~
    Q320=+2 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0 ~
    Q289=+0 ~
    Q309=+0 ~
    Q330=+0
3 END PGM A MM
