' Drives a square of about one metre and says where it ended.
10 locate 0,0
20 for S = 0 to 3
30 RGB 255 * (S & 1), 120, 60 * S
40 goroll S * 90, 120, 1
50 delay 1500
60 goroll S * 90, 0, 0
70 delay 700
80 print "corner " S + 1 ": " xpos "," ypos
90 next S
100 print "home again"
