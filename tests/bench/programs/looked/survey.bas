' Survey: sorts fifteen answers, looks some up by halving, counts the commonest.
'   orb run tests/bench/programs/looked/survey.bas --lines-per-second 1000000 --for 60s
10 data 7,3,9,3,12,7,1,5,7,11,2,9,4,8,7
20 for Y = 1 to 15
30 read Z
40 next Y
50 for I = 2 to 15
60 Y = I
70 V = Z
80 Y = Y - 1
90 if Y < 1 then goto 140
100 W = Z
105 if W < V + 1 then goto 140
110 Y = Y + 1
120 Z = W
125 Y = Y - 1
130 goto 80
140 Y = Y + 1
150 Z = V
160 next I
170 V = 4
180 gosub 400
190 V = 6
200 gosub 400
210 V = 12
220 gosub 400
230 for Y = 1 to 15
240 if Z = P then C = C + 1 else C = 1
250 P = Z
260 if C < B + 1 then goto 290
270 B = C
280 M = Z
290 next Y
300 Y = 8
310 print "median", Z, "commonest", M, "x", B
320 end
400 L = 1
410 H = 15
420 Y = (L + H) / 2
430 if Z = V then goto 480
440 if Z < V then L = Y + 1 else H = Y - 1
450 if L < H + 1 then goto 420
460 print V, "is missing"
470 return
480 print V, "is at", Y
490 return
