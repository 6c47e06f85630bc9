' Metronome: asks for the tempo, then keeps it by timerA, so that the work of a beat costs nothing.
'   orb run examples/lights/metronome.bas --input 96
10 print "beats per minute?"
20 input T,3000,120
30 if T < 30 or T > 240 then T = 120
40 print "tempo", T
50 timerA = 60000 / T
60 for B = 1 to 16
70 if B % 4 = 1 then RGB 255,60,0 else RGB 0,60,255
80 delay 60
90 RGB 0,0,0
100 if timerA > 0 then goto 100
110 timerA = 60000 / T
120 next B
