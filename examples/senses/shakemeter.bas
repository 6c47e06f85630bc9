' Shake thermometer: the harder it is shaken the warmer it gets; it cools down slowly.
'   orb run examples/senses/shakemeter.bas --stimulus examples/senses/shakemeter.stimulus --for 10s
10 W = 0
20 M = abs ((accelone - 1000) / 12)
30 if M > W then W = M
40 if W > 255 then W = 255
50 RGB W,0,255 - W
60 if W > 200 and P < 201 then ? "hot!"
70 P = W
80 if W > 1 then W = W - 2
90 delay 25
100 goto 20
