' Shy: push it and it runs away from you, then it calms down.
'   orb run examples/senses/shy.bas --stimulus examples/senses/shy.stimulus --for 10s --svg shy.svg
10 RGB 0,60,30
20 X = xpos
30 Y = ypos
40 delay 100
50 if abs (xpos - X) < 2 and abs (ypos - Y) < 2 then goto 20
' pushed: flee the way the push went
60 RGB 255,40,140
70 if abs (xpos - X) > abs (ypos - Y) then gosub 200 else gosub 300
80 goroll H,140,2
90 delay 600
100 goroll H,0,0
110 delay 900
120 goto 10
200 if xpos > X then H = 90 else H = 270
210 return
300 if ypos > Y then H = 0 else H = 180
310 return
