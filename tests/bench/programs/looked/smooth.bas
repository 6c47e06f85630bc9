' Smooth: the mean of the last eight slopes raises an alarm and ends it again lower.
'   orb run tests/bench/programs/looked/smooth.bas --lines-per-second 1000000 --stimulus tests/bench/programs/tilts.stimulus --for 30s
10 for N = 1 to 70
20 Y = P + 1
30 P = Y % 8
40 Z = abs pitch
50 S = 0
60 for Y = 1 to 8
70 S = S + Z
80 next Y
90 S = S / 8
100 if A = 1 then goto 160
110 if S < 16 then goto 270
120 A = 1
130 C = C + 1
140 RGB 255,0,0
150 print "alarm at", N, "level", S
155 goto 270
160 if S > 7 then goto 270
170 A = 0
180 RGB 0,128,0
190 Y = 1
200 L = Z
210 M = Z
220 for Y = 2 to 8
230 if Z < L then L = Z
240 if Z > M then M = Z
250 next Y
260 print "calm at", N, "spread", M - L
270 delay 100
280 next N
290 if A = 1 then print "still alarmed"
300 print C, "alarms"
