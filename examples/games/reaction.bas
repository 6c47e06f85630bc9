' Reaction game: when the ball turns green, send any number as fast as you can.
'   orb run examples/games/reaction.bas --stimulus examples/games/reaction.stimulus
10 for R = 1 to 3
20 RGB 80,0,0
30 delay 800 + rnd 1200
40 RGB 0,255,0
50 timerA = 0
60 input X,1500,0
70 T = timerA
80 if X = 0 then print "too slow" else print T " ms"
90 RGB 0,0,0
100 delay 700
110 next R
