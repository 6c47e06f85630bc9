' Maze: a walker on a grid of five by five keeps its right hand on the wall until it finds the exit.
'   orb run tests/bench/programs/looked/maze.bas --lines-per-second 1000000 --for 60s
10 for Y = 2 to 22 step 5
20 Z = 1
30 next Y
40 Y = 12
50 Z = 0
60 for Y = 9 to 19 step 5
70 Z = 1
80 next Y
90 A = 1
100 B = 1
110 D = (D + 1) % 4
120 P = A
130 Q = B
140 if D = 0 then Q = B + 1
150 if D = 1 then P = A + 1
160 if D = 2 then Q = B - 1
170 if D = 3 then P = A - 1
180 if P < 1 or P > 5 then goto 220
190 if Q < 1 or Q > 5 then goto 220
200 Y = Q * 5 + P - 5
210 if Z = 0 then goto 250
220 D = (D + 3) % 4
230 T = T + 1
240 goto 120
250 A = P
255 B = Q
260 S = S + 1
270 goroll D * 90,60,1
280 delay 200
290 print A, B
300 if A + B < 10 then goto 110
310 goroll 0,0,0
320 print S, "steps,", T, "turns"
