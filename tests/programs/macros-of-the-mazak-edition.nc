; In Renishaw's edition A-4013-0113 for a Mazak P9817 is a rectangle, P9801 calibrates by its letter K, and S with H, S with T and T with M exclude each other
;    in every measuring macro. S103 is G54.1 P3. The program is not taken for one of a Centroid, whose P9817 is a hole.
; read:
; calls: 3 G65 P9801: calibrates the probe | 4 G65 P9817: rectangle: four sides and its angle | 5 G65 P9817: rectangle: four sides and its angle
;    | 6 G65 P9814: hole or boss, four touches; S and H exclude each other | 7 G65 P9812: web or slot; T and M exclude each other
;    | 8 G65 P9818: turns the B axis until a surface is square | 9 G65 P9817: rectangle: four sides and its angle; A is 15: 11 to 14 is possible | 10 G65 P9801: calibrates the probe
;    | 11 G65 P9835: corrects a tool by the mean of several parts | 12 G65 P9814: hole or boss, four touches
; run:
; writes: 4 offset G54.1 P3 ? ? | 5 offset G54 ? ? | 6 offset G54.1 P250 ? ? | 7 wear tool 12 ? ? | 10 length tool 1 ? ? | 11 wear tool 12 ? ? | 12 offset G154 P7 ? ?
O1
G90 G0 X0. Y0. Z-5.
G65 P9801 K4. D50. B6. M180.
G65 P9817 D60. E40. S103.
G65 P9817 E40. D60. S1. T20.
G65 P9814 D25. H0.05 S350.
G65 P9812 X30. T12. M0.1
G65 P9818 K2. X100. Z0.
G65 P9817 D60. E40. A15.
G65 P9801 K1. Z0. B6. T1.01
G65 P9835 T12. M90. C3.
G65 P9814 D25. S154.07
M30
