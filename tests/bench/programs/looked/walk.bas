' Random walk: steps in one of four directions inside a fence, until far out or tired.
'   orb run tests/bench/programs/looked/walk.bas --seed 4 --for 120s
10 W = rnd 3
20 A = X
30 B = Q
40 on W goto 70,90,110
50 B = B + 1
60 goto 120
70 A = A + 1
80 goto 120
90 B = B - 1
100 goto 120
110 A = A - 1
120 if abs A > 3 or abs B > 3 then goto 170
130 X = A
140 Q = B
150 goroll W * 90,50,1
160 goto 190
170 T = T + 1
180 RGB 255,0,0
190 delay 200
200 RGB 0,60 * ((abs X) + 1),60 * ((abs Q) + 1) % 256
210 S = S + 1
220 if S < 40 and T < 9 then goto 10
230 goroll 0,0,0
240 print "at", X, Q, "after", S
250 if X = 0 and Q = 0 then goto 280
260 if abs X = 3 or abs Q = 3 then print "at the fence" else print "somewhere"
270 end
280 print "home"
