' Moving average: keeps the last eight readings of the tilt in a ring and reacts to their mean.
'   orb run tests/bench/programs/looked/average.bas --lines-per-second 1000000 --stimulus tests/bench/programs/tilts.stimulus --for 20s
10 A = 1
20 for N = 1 to 60
30 Y = A
40 V = abs pitch
50 S = S - Z + V
60 Z = V
70 A = A % 8 + 1
80 if F < 8 then F = F + 1
90 M = S / F
100 if M > 14 then goto 140
110 if M < 5 then RGB 0,255,0 else RGB 255,160,0
120 W = 0
130 goto 180
140 RGB 255,0,0
150 if W = 1 then goto 180
160 W = 1
170 print "steep: ", M
180 if N % 20 = 0 then print N, "readings, mean", M
190 delay 100
200 next N
210 print "last mean", M
