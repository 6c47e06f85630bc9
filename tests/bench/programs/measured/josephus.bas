' Plays the Josephus game: twelve children in a circle, every fifth one is out, and the last one left wins
'   orb run tests/bench/programs/measured/josephus.bas --for 60s
10 for T = 1 to 11
20 for K = 1 to 5
30 Y = Y%12+1
40 if Z > 0 then goto 30
50 next K
60 Z = 1
70 P = Y
80 Y = T+12
90 Z = P
100 Y = P
110 LEDC 1
120 backLED 240-T*20
130 print "turn",T": child",P" is out"
140 delay 300
150 LEDC 3
160 delay 200
170 next T
180 Y = Y%12+1
190 if Z > 0 then goto 180
200 print "child",Y" wins"
210 for K = 1 to 3
220 LEDC 2
230 goroll Y*30-30,60,1
240 delay 200
250 LEDC 6
260 goroll Y*30-30,0,0
270 delay 300
280 next K
290 print "they went like this:";
300 for Y = 13 to 23
310 print " "Z;
320 next Y
330 print
340 LEDC 0
