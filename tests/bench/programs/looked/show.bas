' Light show: three fades, a rainbow by hue, and a strobe that gets faster.
'   orb run tests/bench/programs/looked/show.bas --for 120s
10 R = 255
20 gosub 300
30 R = 0
40 G = 255
50 gosub 300
60 G = 128
70 B = 255
80 gosub 300
90 for H = 0 to 350 step 10
100 V = (abs (H - 180)) * 4 - 240
110 gosub 400
120 R = V
130 V = 480 - (abs (H - 120)) * 4
140 gosub 400
150 G = V
160 V = 480 - (abs (H - 240)) * 4
170 gosub 400
180 RGB R,G,V
190 delay 30
200 next H
210 W = 200
220 RGB 255,255,255
230 delay W
240 RGB 0,0,0
250 delay W
260 W = W * 4 / 5
270 if W > 19 then goto 220
280 print "the end"
290 end
300 for I = 0 to 21
310 K = I
320 if I > 10 then K = 21 - I
330 RGB R * K / 10,G * K / 10,B * K / 10
340 delay 50
350 next I
360 return
400 if V < 0 then V = 0
410 if V > 255 then V = 255
420 return
