' Bubble sort with a flag: fills ten elements, sorts them, checks and shows the middle.
'   orb run tests/bench/programs/looked/bubble.bas --seed 9
10 for Y = 1 to 10
20 Z = rnd 99
30 next Y
40 gosub 300
50 C = 0
60 for I = 1 to 9
70 Y = I
80 A = Z
90 Y = I + 1
100 if Z > A - 1 then goto 160
110 B = Z
120 Z = A
130 Y = I
140 Z = B
150 S = S + 1
155 C = 1
160 next I
170 if C = 1 then goto 50
180 gosub 300
190 print "sorted with", S
200 for Y = 1 to 10
210 T = T + Z
220 next Y
230 Y = 5
240 print "mean", T / 10, "median", Z
250 end
300 for Y = 1 to 10
310 print Z, "";
320 next Y
330 print ""
340 return
