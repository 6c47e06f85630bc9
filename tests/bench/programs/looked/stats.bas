' Statistics: throws a loaded die, keeps counts, finds the most and the least frequent face, checks fairness.
'   orb run tests/bench/programs/looked/stats.bas --seed 11
10 for T = 1 to 80
20 Y = rnd 7
30 if Y < 1 or Y > 6 then Y = 6
40 Z = Z + 1
50 next T
60 H = 1
70 L = 1
80 for F = 1 to 6
90 Y = F
100 gosub 300
110 C = Z
120 Y = H
130 if C > Z then H = F
140 Y = L
150 if C < Z then L = F
160 next F
170 print "most:";
180 Y = H
190 gosub 300
200 C = Z
210 print "least:";
220 Y = L
230 gosub 300
240 if C > 2 * Z then goto 280
250 RGB 0,255,0
260 print "fair"
270 end
280 RGB 255,0,0
290 print "loaded"
295 end
300 print "face", Y, "came", Z
310 return
