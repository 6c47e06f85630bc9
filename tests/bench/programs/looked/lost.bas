' Lost: a walker takes random steps on a field of four by four until it has seen all of it, or gives up.
'   orb run tests/bench/programs/looked/lost.bas --lines-per-second 1000000 --seed 3 --for 90s
10 X = 1
20 B = 1
30 goto 150
40 P = X
50 Q = B
60 W = rnd 4
70 if W % 2 = 0 then P = X + 3 - W else Q = B + 2 - W
80 if P < 1 or P > 4 then goto 40
90 if Q < 1 or Q > 4 then goto 40
100 X = P
110 B = Q
120 S = S + 1
130 goroll W * 90 - 90,80,1
140 delay 300
150 Y = B * 4 - 4 + X
160 if Z = 1 then RGB 0,0,255 else RGB 0,255,0
170 if Z = 0 then F = F + 1
180 Z = 1
190 if F < 16 and S < 100 then goto 40
200 goroll 0,0,0
210 if F = 16 then print "seen all in", S, "steps" else print "gave up after", F, "fields"
220 for Y = 1 to 16
230 if Z = 1 then print "#"; else print ".";
240 if Y % 4 = 0 then print ""
250 next Y
