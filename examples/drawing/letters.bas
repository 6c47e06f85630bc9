' Letters: writes OLE on the floor. The LED is the pen: lit it draws, dark it only moves.
' A stroke is one number: quarter turn * 100000 + pen * 10000 + milliseconds.
'   orb run examples/drawing/letters.bas --svg letters.svg
10 data 11400,110800,211400,310800,101400,1400,211400,110800,100600,110800,300800,10745,110600,300600,10745,110800
20 for N = 1 to 16
30 read C
40 H = C / 100000 * 90
50 P = C / 10000 % 10
60 LEDC P * (N % 7 + 1)
70 goroll H,0,1
80 delay 250
90 goroll H,70,1
100 delay C % 10000
110 goroll H,0,0
120 delay 400
130 next N
140 LEDC 0
