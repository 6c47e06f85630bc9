' Tag: the ball flees at random; each touch costs a life, each quiet second is a point; a shake ends it.
'   orb run tests/bench/programs/looked/tag.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 60s
10 L = 3
20 V = 1
30 S = 40 + V * 20
40 if S > 160 then S = 160
50 goroll (rnd 12) * 30 - 30,S,1
60 RGB 0,255,0
70 for I = 1 to 10
80 delay 100
90 if abs accelX > 5000 or abs accelY > 5000 then goto 170
100 next I
110 P = P + V
120 if P < V * 5 then goto 240
130 V = V + 1
140 print "level", V
150 if V > 6 then goto 300
160 goto 240
170 for I = 1 to 3
180 RGB 255,0,0
190 delay 100
200 RGB 0,0,0
210 delay 100
220 next I
225 L = L - 1
240 if dshake = 1 then goto 320
250 if L > 0 then goto 30
260 goroll 0,0,0
270 print "caught with", P
280 end
300 X = dshake
305 if X = 1 then goto 320
307 goroll 0,0,0
310 print "escaped with", P
315 end
320 goroll 0,0,0
330 print "stopped with", P
