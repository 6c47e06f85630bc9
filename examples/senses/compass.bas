' Compass: turn the ball by hand; north is blue, east green, south red, west yellow.
'   orb run examples/senses/compass.bas --stimulus examples/senses/compass.stimulus --for 9s
10 ctrl = 0
20 data 3,2,1,7
30 Q = (yaw + 45) % 360 / 90
40 rstr
50 for I = 0 to Q
60 read C
70 next I
80 LEDC C
90 if Q ! L then print "facing quarter", Q
100 L = Q
110 backLED yaw * 255 / 359
120 delay 100
130 goto 30
