' Lawn: mows in rows, up and down; a stone in the way is gone around, three stones are too many.
'   orb run tests/bench/programs/looked/lawn.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 90s
10 RGB 0,255,0
20 M = 0
30 P = 1
40 goroll H,50,1
50 delay 100
60 if abs accelX < 6001 and abs accelY < 6001 then goto 140
70 S = S + 1
80 RGB 255,0,0
90 goroll 270,50,1
100 delay 400
110 RGB 0,255,0
120 M = 1
130 if S = 3 then goto 250
140 P = P + 1
150 if P < 13 then goto 40
160 if M = 1 then print "stone in row", R + 1
170 goroll 90,50,1
180 delay 300
190 R = R + 1
200 H = 180 - H
210 if R < 8 then goto 20
220 goroll 0,0,0
230 print "done,", R, "rows,", S, "stones"
240 end
250 print "stone in row", R + 1
260 goroll 0,0,0
270 print "help!"
