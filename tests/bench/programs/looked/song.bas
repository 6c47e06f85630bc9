' Song of lights: notes and lengths are read; each is a colour, a rest is dark; twice, the second time faster.
'   orb run tests/bench/programs/looked/song.bas
5 data 1,1,2,1,3,2,0,1,5,1,4,1,3,4,0,2,6,1,7,3,0-1
10 T = 120
20 for V = 1 to 2
30 rstr
40 read N
50 if N < 0 then goto 180
60 read L
70 if N = 0 then RGB 0,0,0
80 if N > 0 and N < 4 then RGB N * 80,0,0
90 if N > 3 and N < 7 then RGB 0,(N - 3) * 80,0
100 if N > 6 then RGB 0,0,255
110 delay L * T
120 S = S + L
130 if L < 3 then goto 40
140 backLED 255
150 delay 100
160 backLED 0
170 goto 40
180 print "verse ", V, "beats", S
190 T = T - 40
200 next V
