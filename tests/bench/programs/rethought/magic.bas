' builds a magic square of 25 numbers, shows and checks it, spoils it and checks again
'   orb run tests/bench/programs/rethought/magic.bas --for 60s
' the list: the square, row by row; P: the place of a number N
' W: wrong lines; S: sum of a row or column; F, G: sums of the diagonals
10 Y = 3
20 for N = 1 to 25
30 Z = N
40 P = Y
50 Y = (Y + 19) % 25 / 5 * 5 + Y % 5 + 1   ' up and right
60 if Z > 0 then Y = (P + 4) % 25 + 1      ' taken: below
70 next N
80 gosub 180
90 Y = 1
100 A = Z
110 Y = 2
120 B = Z
130 Z = A
140 Y = 1
150 Z = B
160 gosub 180
170 end
180 W = 0
190 F = 0
200 G = 0
210 for N = 1 to 5
220 S = 0
230 for Y = N * 5 - 4 to N * 5
240 print Z " ";
250 S = S + Z
260 next Y
270 print ""
280 if S ! 65 then W = W + 1
290 S = 0
300 for Y = N to 25 step 5
310 S = S + Z
320 next Y
330 if S ! 65 then W = W + 1
340 Y = N * 6 - 5
350 F = F + Z
360 Y = N * 4 + 1
370 G = G + Z
380 next N
390 if F ! 65 then W = W + 1
400 if G ! 65 then W = W + 1
410 if W > 0 then LEDC 1 else LEDC 2
420 if W > 0 then print W, "lines are wrong" else print "magic"
430 delay 1000
440 return
