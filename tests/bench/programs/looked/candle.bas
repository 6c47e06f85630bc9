' Candle: flickers, burns down, goes out in a draught (a shake) and is lit again, twice.
'   orb run tests/bench/programs/looked/candle.bas --lines-per-second 1000000 --stimulus tests/bench/programs/shakes.stimulus --for 60s
10 H = 100
20 M = 2
30 R = H * 2 + 55
40 if R > 255 then R = 255
50 G = H - (rnd 20)
60 if G < 0 then G = 0
70 RGB R,G,0
80 delay 80 + rnd 40
90 H = H - 1
100 if dshake = 1 then goto 130
110 if H > 0 then goto 30
120 goto 250
130 print "out at", H
135 if H = 0 then goto 250
140 for J = 1 to 3
150 for I = 8 to 1 step -1
160 RGB I * 10,I * 10,I * 10
170 delay 60
180 next I
190 RGB 0,0,0
200 next J
210 if M = 0 then goto 240
220 M = M - 1
230 goto 30
240 print "no matches"
250 RGB 0,0,0
260 if H = 0 then print "burnt down"
270 print M, "matches left"
