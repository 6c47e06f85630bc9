' Builds the Fibonacci word in an array and draws its curve: a step for each letter, and a turn at the zeros
'   orb run tests/bench/programs/measured/fibword.bas --for 60s
10 Y = 2
20 Z = 1
30 S = 1
40 L = 2
50 for Y = 1 to S
60 if Z = 0 then goto 100
70 Y = Y+L
80 Z = 1
90 Y = Y-L
100 next Y
110 L = L+S
120 S = L-S
130 print L" letters"
140 if L < 21 then goto 50
150 for Y = 1 to 21
160 print Z;
170 next Y
180 print
190 for Y = 1 to 21
200 goroll H,60,1
210 delay 400
220 goroll H,0,0
230 delay 300
240 LEDC 2+(Z-1)*(1-Y%2*2)
250 H = (H+(1-Z)*(270-Y%2*180))%360
260 T = T+Z
270 next Y
280 print 21-T" turns, now heading",H
