' Maze: drives until it bumps into something, then turns right; no map, only its own speed.
'   orb run examples/places/maze.bas --stimulus examples/places/maze.stimulus --svg maze.svg
10 locate 0,0
20 for B = 1 to 8
30 RGB 0,200,120
40 goroll H,90,1
50 delay 700
' rolling on: the speed stays up until something stops the ball
60 if speed > 45 then goto 60
70 RGB 255,0,0
80 print "bump", B ":", xpos, ypos
90 H = (H + 90) % 360
100 goroll H,0,0
110 delay 600
120 next B
