' Spiral: the heading turns by a steady step while the speed grows.
'   orb run examples/drawing/spiral.bas --svg spiral.svg
10 H = 0
20 for V = 20 to 170 step 2
30 RGB V,255 - V,255
40 goroll H,V,1
50 delay 130
60 H = (H + 15) % 360
70 next V
80 goroll H,0,0
90 print "outside, at " xpos "," ypos
