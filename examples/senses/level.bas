' Spirit level: green when the surface is level, red to one side, blue to the other.
'   orb run examples/senses/level.bas --stimulus examples/senses/level.stimulus --for 8s
10 ctrl = 0
20 T = abs pitch
30 if abs roll > T then T = abs roll
40 if T > 30 then T = 30
50 if T < 3 then goto 90
60 if pitch + roll > 0 then RGB 60 + T * 6,0,0 else RGB 0,0,60 + T * 6
70 delay 100
80 goto 20
90 RGB 0,255,0
100 delay 100
110 goto 20
