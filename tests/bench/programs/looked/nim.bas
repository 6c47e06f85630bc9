' Nim: a greedy player and a random one take from three heaps; who takes the last one wins.
'   orb run tests/bench/programs/looked/nim.bas --lines-per-second 1000000 --seed 4 --for 60s
10 for Y = 1 to 3
20 Z = Y + Y + 1
30 next Y
40 R = 15
50 P = 1
60 if P = 2 then goto 160
70 RGB 0,0,255
80 B = 0
90 for Y = 1 to 3
100 if Z > B then H = Y
110 if Z > B then B = Z
120 next Y
130 Y = H
140 N = rnd 3
150 goto 200
160 RGB 255,0,0
170 Y = rnd 3
180 if Z = 0 then goto 170
190 N = rnd 2
200 if N > Z then N = Z
210 Z = Z - N
220 R = R - N
230 M = M + 1
240 print "player", P, "takes", N, "from", Y
250 delay 500
260 if R = 0 then goto 290
270 P = 3 - P
280 goto 60
290 print "player", P, "wins after", M, "moves"
300 if P = 1 then print "greed pays" else print "what luck"
