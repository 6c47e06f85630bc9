' a parking gate: a shake is a car, the light is the state, the heading is the arm
'   orb run tests/bench/programs/rethought/gate.bas --stimulus tests/bench/programs/shakes.stimulus --lines-per-second 1000000
' S: 1 closed, 3 opening, 5 open, 7 closing, so that S + dshake says what to do
' A: angle of the arm, W: steps waited, N: cars
10 LEDC 1
20 print "closed"
30 S = 1
40 for T = 1 to 130
50 delay 100
60 on S + dshake goto 360,70,130,120,200,260,300,70
70 N = N + 1                               ' a car before the gate
80 LEDC 4
90 print "opening"
100 S = 3
110 goto 360
120 N = N + 1
130 A = A + 10                             ' opening
140 goroll A,0,1
150 if A < 90 then goto 360
160 LEDC 2
170 print "open"
180 S = 5
190 goto 270
200 W = W + 1                              ' open
210 if W < 15 then goto 360
220 LEDC 7
230 print "closing"
240 S = 7
250 goto 360
260 N = N + 1                              ' a car while open
270 W = 0
280 goto 360
300 A = A - 10                             ' closing
310 goroll A,0,1
320 if A > 0 then goto 360
330 LEDC 1
340 print "closed"
350 S = 1
360 next T
370 print N, "cars"
