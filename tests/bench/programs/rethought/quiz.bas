' Asks eight multiplications with a second try and a hint each, and harder ones after three right answers in a row.
'   orb run tests/bench/programs/rethought/quiz.bas --for 60s --seed 2 --input 8,9,10,20,12,30,35,24,12,40
10 H = 4
20 for Q = 1 to 8
30 A = 1 + rnd H
40 B = 1 + rnd H
50 C = A * B
60 P = 2
70 print Q ": " A " x " B " = ?"
80 input G,5000,0
90 if G = C then goto 210
100 if G > C then goto 130
110 if G = 0 then print "too slow" else print G " is too small"
120 goto 140
130 print G " is too big"
140 LEDC 1
150 delay 600
160 LEDC 0
170 P = P - 1
180 if P > 0 then goto 70
190 print "it is", C
200 goto 300
210 print "right"
220 LEDC 2
230 delay 300
240 LEDC 0
250 T = T + P
260 S = S + 1
270 if S < 3 then goto 310
280 H = H + 3
290 print "now up to", H + 1
300 S = 0
310 next Q
320 print T, "of 16 points"
330 if T > 12 then LEDC 2 else LEDC 1
340 delay 2000
350 LEDC 0
