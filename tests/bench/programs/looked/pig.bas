' Pig: two players throw a die; a 1 loses the turn's points, 20 hold, 60 win.
'   orb run tests/bench/programs/looked/pig.bas --lines-per-second 1000000 --for 60s
10 Y = 1
20 P = 0
30 E = rnd 6
40 if E = 1 then goto 100
50 P = P + E
60 if P < 20 and Z + P < 60 then goto 30
70 Z = Z + P
80 if Y = 1 then RGB 0,255,0 else RGB 0,0,255
90 goto 120
100 P = 0
110 RGB 255,0,0
120 T = T + 1
130 delay 200
140 print "player", Y, "gets", P, "has", Z
150 if Z > 59 then goto 180
160 Y = 3 - Y
170 goto 20
180 print "player", Y, "wins after", T, "turns"
