' Star: five strokes, each turned by 144 degrees, each in its own colour.
'   orb run examples/drawing/star.bas --svg star.svg
10 for P = 0 to 4
20 H = P * 144 % 360
30 LEDC P + 1
40 goroll H,0,1
50 delay 400
60 goroll H,120,1
70 delay 1500
80 goroll H,0,0
90 delay 700
100 next P
