' Waltz: steps from a table, danced forwards and backwards, faster each time.
'   orb run tests/bench/programs/looked/waltz.bas --lines-per-second 1000000 --for 90s
10 data 0,2,90,1,180,1,270,2,45,1,225,1
20 for Y = 1 to 12
30 read Z
40 next Y
50 for B = 400 to 200 step -100
60 for I = 1 to 6
70 gosub 200
80 next I
90 for I = 6 to 1 step -1
100 gosub 200
110 next I
120 next B
130 RGB 0,0,0
140 print "36 steps"
150 end
200 Y = I * 2
210 W = Z
220 Y = Y - 1
230 if I % 3 = 0 then RGB 255,0,0
240 if I % 3 = 1 then RGB 0,255,0
250 if I % 3 = 2 then RGB 0,0,255
260 goroll Z,70,1
270 delay W * B
280 goroll Z,0,0
290 backLED W / 2 * 255
300 delay B / 2
310 return
