' Lift: a list of floors to serve, with doors, an alarm when it is shaken, and a count of floors passed.
'   orb run tests/bench/programs/looked/lift.bas --lines-per-second 1000000 --stimulus tests/bench/programs/shakes.stimulus --for 60s
10 Y = 2
20 Z = 1
30 Y = 3
40 Z = 1
50 Y = 6
60 Z = 1
70 N = 3
80 F = 1
90 D = 1
100 RGB 0,0,80
110 Y = F
120 if Z = 0 then goto 190
130 print "floor", F
140 RGB 0,255,0
150 delay 500
160 RGB 0,0,80
170 Z = 0
180 N = N - 1
190 if F = 6 then D = 0-1
200 if F = 1 then D = 1
210 F = F + D
220 delay 400
230 P = P + 1
240 if dshake = 0 then goto 320
250 RGB 255,0,0
260 print "shaken at", F
270 Y = 1
280 if Z = 0 then N = N + 1
290 Z = 1
300 delay 1000
310 RGB 0,0,80
320 if N > 0 then goto 110
330 print "passed", P, "floors"
