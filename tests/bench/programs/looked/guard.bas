' Guard: walks round a yard; who bumps into it is barked at, three times end the watch.
'   orb run tests/bench/programs/looked/guard.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 60s
10 L = 0
20 goroll L * 90,60,1
30 delay 600
40 if abs accelX > 6000 or abs accelY > 6000 then goto 110
50 L = L + 1
60 if L < 4 then goto 20
70 Q = Q + 1
80 RGB 0,80,0
90 if Q < 6 then goto 10
100 goto 210
110 A = A + 1
120 print "somebody on leg", L
130 goroll 0,0,0
140 for I = 1 to A
150 RGB 255,0,0
160 delay 100
170 RGB 0,0,0
180 delay 100
190 next I
200 if A < 3 then goto 10
210 if A = 3 then print "thieves" else print "a quiet night"
220 goroll 0,0,0
