' Polygons: drives a triangle, a square and so on, each smaller and turned, every side in its colour.
'   orb run tests/bench/programs/looked/polygons.bas --lines-per-second 1000000 --for 90s
10 L = 300
20 N = 3
30 gosub 190
40 goroll H,0,0
50 delay 500
60 print N, "sides of", L
70 N = N + 1
80 if L > 150 then L = L - 50
90 H = H + 45
100 if N < 8 then goto 30
110 print "star"
120 N = 4
130 H = 0
140 gosub 190
150 H = 45
160 gosub 190
170 goroll 0,0,0
175 backLED 255
180 end
190 A = H
200 for I = 1 to N
210 on I % 3 + 1 goto 240,260,220
220 RGB 0,0,255
230 goto 270
240 RGB 255,0,0
250 goto 270
260 RGB 0,255,0
270 goroll A,60,1
280 delay L
290 A = (A + 360 / N) % 360
300 next I
310 return
