' Repetitions: counts how often the ball is tipped and put back, with the longest hold and a best score.
'   orb run tests/bench/programs/looked/reps.bas --lines-per-second 1000000 --stimulus tests/bench/programs/tilts.stimulus --for 20s
10 RGB 0,40,0
20 backLED 0
30 delay 100
40 S = S + 1
50 A = abs pitch
60 B = abs roll
70 if B > A then A = B
80 if T = 1 then goto 140
90 if A < 16 then goto 220
100 T = 1
110 H = 0
120 RGB 255,80,0
130 backLED 255
135 goto 220
140 H = H + 1
150 if H > L then L = H
160 if A > 4 then goto 220
170 T = 0
180 R = R + 1
190 RGB 0,40,0
200 backLED 0
210 print "rep", R, "held", H
220 if R < 3 and S < 151 then goto 30
230 if R = 3 then print "well done" else print "too slow"
240 print "longest hold", L
