' Fence: wanders about at random but turns back where it is 40 cm from the middle.
'   orb run examples/places/fence.bas --for 30s --svg fence.svg
10 locate 0,0
20 D = sqrt (xpos * xpos + ypos * ypos)
30 if D > 40 then goto 100
40 H = (H + 315 + rnd 90) % 360
50 RGB 0,255 - D * 4,D * 4
60 goroll H,60,1
70 delay 250
80 goto 20
' outside: turn round, toward the middle
100 RGB 255,0,0
110 if abs xpos > abs ypos then gosub 200 else gosub 300
120 goroll H,60,1
130 delay 600
140 goto 20
200 if xpos > 0 then H = 270 else H = 90
210 return
300 if ypos > 0 then H = 180 else H = 0
310 return
