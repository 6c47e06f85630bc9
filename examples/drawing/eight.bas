' Figure of eight: a circle to the right in blue, a circle to the left in orange, twice.
'   orb run examples/drawing/eight.bas --svg eight.svg
10 for L = 1 to 2
20 RGB 0,120,255
30 for T = 0 to 35
40 goroll T * 10,60,1
50 delay 90
60 next T
70 RGB 255,110,0
80 for T = 0 to 35
90 goroll (360 - T * 10) % 360,60,1
100 delay 90
110 next T
120 next L
130 goroll 0,0,0
