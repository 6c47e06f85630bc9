' Toss: counts how often it is thrown, and how long it flew.
'   orb run examples/senses/toss.bas --stimulus examples/senses/toss.stimulus
10 C = 0
20 RGB 0,0,90
30 if accelone > 300 then goto 30
' in the air
40 timerA = 0
50 RGB 255,255,0
60 if accelone < 300 then goto 60
70 T = timerA
80 C = C + 1
90 print "toss", C ": " T " ms"
100 RGB 255,0,0
110 delay 500
120 if C < 3 then goto 20
