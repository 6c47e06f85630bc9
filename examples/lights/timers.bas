' Three timers at once: red, green and blue blink each in their own rhythm.
'   orb run examples/lights/timers.bas --for 6s
10 timerA = 300
20 timerB = 500
30 timerC = 700
40 if timerA = 0 then gosub 100
50 if timerB = 0 then gosub 200
60 if timerC = 0 then gosub 300
70 RGB R,G,B
80 delay 5
90 goto 40
100 R = 255 - R
110 timerA = 300
120 return
200 G = 255 - G
210 timerB = 500
220 return
300 B = 255 - B
310 timerC = 700
320 return
