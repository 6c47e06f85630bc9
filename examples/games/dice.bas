' Dice: shake the ball; it flickers, then blinks the number that was thrown.
'   orb run examples/games/dice.bas --stimulus examples/games/dice.stimulus
10 T = 0
20 delay 50
30 if dshake = 0 then goto 20
40 for F = 1 to 12
50 RGB rnd 255,rnd 255,rnd 255
60 delay 40 + F * 8
70 next F
80 D = rnd 6
90 print "thrown:", D
100 for F = 1 to D
110 RGB 0,0,0
120 delay 180
130 RGB 255,255,255
140 delay 180
150 next F
160 RGB 0,0,0
170 T = T + 1
180 if T < 3 then goto 20
190 print "three throws, good night"
