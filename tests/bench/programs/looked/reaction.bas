' Reaction: after a random wait the ball turns green; the time until it is bumped counts, five times.
'   orb run tests/bench/programs/looked/reaction.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 60s
10 B = 60
20 for N = 1 to 5
30 RGB 255,0,0
40 L = 10 + rnd 20
50 delay 50
60 L = L - 1
70 if abs accelX < 2001 and abs accelY < 2001 then goto 110
80 E = E + 1
90 RGB 255,0,255
100 L = 10 + rnd 20
110 if L > 0 then goto 50
120 RGB 0,255,0
130 T = 1
140 delay 20
150 if abs accelX > 2000 or abs accelY > 2000 then goto 200
160 T = T + 1
170 if T < 61 then goto 140
180 M = M + 1
185 print "try", N, "missed"
190 goto 230
200 S = S + T
210 if T < B then B = T
220 print "try", N, T * 20, "ms"
230 next N
240 RGB 0,0,0
250 if M < 5 then print "best", B * 20, "mean", S * 20 / (5 - M)
260 print "missed", M, "early", E
