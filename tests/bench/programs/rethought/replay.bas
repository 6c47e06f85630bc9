' records moves that the user types, replays them, and drives all the way back home
'   orb run tests/bench/programs/rethought/replay.bas --input 3,2,3,1,5,3,3,1,0
' type 1 to turn left, 2 to turn right, 3 to drive a step, 0 when done
' M: the move typed; D and the list: degrees to turn, 0 or 360 drives; H: heading
10 Y = 1
20 input M,20000,0
30 if M = 0 then goto 100
40 if M < 0 or M > 3 then goto 260
50 D = (3 - M) * 3 / 2 * 90               ' 270, 90, 0
60 Z = D
70 gosub 280
80 Y = Y + 1
90 if Y < 21 then goto 20
100 N = Y - 1
110 print N, "moves recorded"
120 if N = 0 then goto 250
130 for Y = 1 to N
140 D = Z
150 gosub 280
160 next Y
170 D = 180
180 gosub 280
190 for T = 1 to 2
200 for Y = N to 1 step -1
210 D = 360 - Z
220 gosub 280
230 next Y
240 next T
250 end
260 print "no such move:", M
270 goto 20
280 if D % 360 = 0 then goto 330
290 H = (H + D) % 360
300 LEDC 7
310 goroll H,0,1
320 goto 370
330 LEDC 2
340 goroll H,60,1
350 delay 1000
360 goroll H,0,0
370 delay 500
380 return
