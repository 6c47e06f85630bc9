' Spirals: squares that grow, then shrink, each side in a colour by its heading.
'   orb run tests/bench/programs/looked/spirals.bas --for 120s
10 S = 2
20 for R = 1 to 2
30 for T = 1 to 4
50 for K = 0 to 3
60 H = T * 10 + K * 90
70 C = H
80 if C > 255 then C = 255
90 RGB C,255 - C,H / 4
100 goroll H,60,1
110 for D = 1 to S
120 delay 100
130 next D
140 next K
150 if R = 1 then S = S + 2 else S = S - 2
160 next T
170 goroll 0,0,0
180 print "round ", R, "side", S
190 delay 1000
200 next R
