' Tilt steering: the way the ball is tipped becomes a direction, its amount a speed.
'   orb run tests/bench/programs/looked/tilt.bas --lines-per-second 1000000 --stimulus tests/bench/programs/tilts.stimulus --for 12s
10 ctrl = 0
20 S = abs pitch
30 if abs roll > S then S = abs roll
40 if S > 3 then goto 90
50 RGB 0,255,0
60 goroll 0,0,0
70 N = N + 1
80 goto 180
90 if S < 16 then RGB 255,160,0 else RGB 255,0,0
100 if pitch > 0 then D = 0 else D = 180
110 if abs pitch > (abs roll) - 1 then goto 130
120 if roll > 0 then D = 90 else D = 270
130 P = S * 4
140 if P > 120 then P = 120
150 goroll D,P,1
160 M = M + 1
170 if S > 4 and M % 10 = 0 then print "moves ", M
180 delay 100
190 if N < 20 and M < 61 then goto 20
200 goroll 0,0,0
210 print "moves", M, "stops", N
