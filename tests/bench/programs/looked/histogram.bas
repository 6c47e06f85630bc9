' Histogram: throws two dice many times and draws how often each sum came.
'   orb run tests/bench/programs/looked/histogram.bas --seed 5
10 for T = 1 to 60
20 A = 1 + rnd 5
30 Y = A + 1 + rnd 5
40 Z = Z + 1
50 if Z > H then H = Z
60 next T
70 for Y = 2 to 12
80 print Y, Z, "";
90 L = Z
100 if L > 20 then L = 20
105 if L < 1 then goto 140
110 for K = 1 to L
120 print "*";
130 next K
140 print ""
150 next Y
160 for Y = 2 to 12
170 if Z = H and M = 0 then M = Y
180 next Y
190 print "most often:", M
200 if H > 10 then goto 230
210 if H > 7 then print "as it should be" else print "quite even"
220 end
230 print "that is a lot"
