' Polygons: a triangle, a square, a pentagon and a hexagon, one inside the other.
'   orb run examples/drawing/polygons.bas --svg polygons.svg
10 for N = 3 to 6
20 LEDC N - 2
30 for S = 0 to N - 1
40 goroll S * 360 / N,0,1
50 delay 350
60 goroll S * 360 / N,90,1
70 delay 1100
80 goroll S * 360 / N,0,0
90 delay 450
100 next S
110 print N " corners"
120 next N
