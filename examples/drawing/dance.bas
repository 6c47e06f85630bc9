' Dance: four figures, called from a score; every figure has its own colour.
'   orb run examples/drawing/dance.bas --report dance.html
10 data 1,2,1,3,4,2,1,4
20 for B = 1 to 8
30 read F
40 print "figure", F
50 on F gosub 100,200,300,400
60 next B
70 goroll 0,0,0
80 RGB 255,255,255
90 end
' 1: a step forward and a step back
100 RGB 255,0,80
110 goroll 0,110,1
120 delay 450
130 goroll 180,110,1
140 delay 450
150 return
' 2: a round to the right
200 RGB 80,0,255
210 for A = 0 to 11
220 goroll A * 30,80,1
230 delay 110
240 next A
250 return
' 3: side to side
300 RGB 255,160,0
310 for A = 1 to 4
320 goroll A % 2 * 180 + 90,120,1
330 delay 350
340 next A
350 return
' 4: stand and blink
400 goroll 0,0,0
410 for A = 1 to 6
420 LEDC A
430 backLED A % 2 * 255
440 delay 120
450 next A
460 return
