' Traffic light: red, red and amber, green, amber; a bump is a walker who wants to cross.
'   orb run tests/bench/programs/looked/traffic.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 30s
10 S = 1
20 L = 10
30 on S goto 40,60,70,90
40 RGB 255,0,0
45 L = 30
50 goto 100
60 RGB 255,90,0
65 goto 100
70 RGB 0,255,0
75 L = 40
80 goto 100
90 RGB 255,160,0
100 delay 100
110 L = L - 1
120 if abs accelX < 8001 or W = 1 then goto 150
130 W = 1
140 print "walker"
150 if S = 3 and L > 5 then L = L - W * (L - 5)
160 if L > 0 then goto 100
170 S = S + 1
180 if S < 5 then goto 20
190 W = 0
200 C = C + 1
210 if C < 3 then goto 10
220 RGB 0,0,0
230 print "cycles: ", C
