' Patrol: goes along a course of legs, turns away when it runs into something, counts.
'   orb run tests/bench/programs/looked/patrol.bas --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus --for 60s
10 RGB 0,0,255
20 if L % 2 = 0 then goroll 90,70,1 else goroll 225,70,1
30 delay 700
40 L = L + 1
50 if abs accelX > 6000 or abs accelY > 6000 then goto 90
60 RGB 0,0,255
70 if L < 12 then goto 20
80 goto 150
90 B = B + 1
100 RGB 255,0,0
110 goroll 0,0,0
120 delay 300
130 if B < 5 then goto 70
140 print "too many bumps"
150 goroll 0,0,0
160 print L, "legs", B, "bumps"
