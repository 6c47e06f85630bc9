' Disco: fades, flashes and a chase of colours, each part twice as fast as the one before.
'   orb run tests/bench/programs/looked/disco.bas --lines-per-second 1000000 --for 120s
10 W = 80
20 for P = 1 to 3
30 print "part", P
40 A = 255
50 gosub 300
60 A = 0
70 B = 255
80 gosub 300
90 B = 0
100 C = 255
110 gosub 300
120 C = 0
130 for I = 1 to P * 2
140 RGB 255,255,255
150 delay W
160 RGB 0,0,0
170 delay W
180 next I
190 for I = 1 to P
200 for J = 1 to 7
210 LEDC J
220 delay W
230 next J
240 next I
250 if P < 3 then backLED P * 100 else backLED 0
260 W = W / 2
270 next P
280 RGB 0,0,0
290 print "good night"
295 end
300 for I = 0 to 8
310 RGB A * I / 8,B * I / 8,C * I / 8
320 delay W
330 next I
340 for I = 8 to 0 step -1
350 RGB A * I / 8,B * I / 8,C * I / 8
360 delay W
370 next I
380 return
