' Race: two virtual runners are diced, the track is read from data, the winner lights up.
'   orb run tests/bench/programs/looked/race.bas --seed 8 --for 60s
5 data 0,0,1,0,1,1,0,0,1,0
10 for Y = 1 to 10
20 read Z
30 next Y
50 T = 1
60 if T = 1 then R = R + 1
70 Y = 10 + T
80 Z = Z + 1 + rnd 5
90 if Z > 30 then Z = 30
100 if Z > 10 then goto 160
110 P = Z
120 Y = P
130 M = Z
135 Y = 10 + T
140 if M = 1 then Z = P - 1
150 if M = 1 then print "mud for", T
160 if T = 1 then LEDC 1 else LEDC 5
170 delay 50
180 if Z > 29 then goto 210
190 T = 3 - T
200 goto 60
210 for K = 1 to T
220 RGB 255,255,255
230 delay 200
240 RGB 0,0,0
250 delay 200
260 next K
270 Y = 13 - T
280 print "winner:", T, "in", R, "rounds,";
290 print "", Z, "for the other"
