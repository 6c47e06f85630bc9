' Bounce: drives straight until it hits something, turns away and counts; slow or too many hits end the game.
'   orb run tests/bench/programs/looked/bounce.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 60s
10 L = 3
20 RGB 0,255,0
30 goroll D,80,1
40 for T = 1 to 15
50 delay 100
60 if abs accelX > 6000 or abs accelY > 6000 then goto 120
70 P = P + 1
80 next T
90 D = (D + 90) % 360
100 if P < 81 then goto 30
105 print "enough points"
110 goto 200
120 L = L - 1
130 RGB 255,0,0
140 goroll D,0,0
150 delay 250
160 D = (D + 135) % 360
170 if L > 1 then goto 20
175 if L = 0 then goto 190
180 RGB 255,160,0
185 goto 30
190 print "no lives left"
200 goroll 0,0,0
210 print P, "points"
