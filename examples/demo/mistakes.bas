' The square with three mistakes in it: orb check names them all at once.
10 locate 0,0
20 for S = 0 to 3
30 rgb 255 * (S & 1), 120, 60 * S
40 goroll S * 90, 120, 1
50 delay 1500
60 goroll S * 90, 0
70 delay 700
80 print "corner " S + 1 ": " xpos "," ypos
90 next T
100 print "home again"
