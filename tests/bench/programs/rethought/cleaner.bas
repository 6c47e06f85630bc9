' Cleans a floor of 4 by 4 tiles in a spiral, avoids the furniture, and prints in which order it cleaned the tiles.
'   orb run tests/bench/programs/rethought/cleaner.bas --for 60s
10 for Y = 5 to 25 step 5                  ' 5 by 5 with walls to the right and below
20 Z = 98
30 next Y
40 for Y = 21 to 24
50 Z = 98
60 next Y
70 Y = 8
80 Z = 99                                  ' furniture
90 Y = 1
100 H = 1
110 goto 150
120 goroll H * 90,60,1
130 delay 500
140 goroll H * 90,0,0
150 N = N + 1
160 Z = N
170 RGB 255,165,0
180 delay 300
190 RGB 0,128,0
200 backLED N * 17
210 P = Y
220 G = H
230 Y = (P + (757779 } (H * 5) & 31)) % 25 + 1     ' the table holds 19, 0, 4, 23
240 if Z = 0 then goto 120
250 H = (H + 1) % 4
260 if H ! G then goto 230
270 for Y = 1 to 20
280 if Z = 98 then print "" else print Z " ";
290 next Y
