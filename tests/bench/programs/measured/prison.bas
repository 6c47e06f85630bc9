' guard.bas: a prison guard who paces round a yard and shouts, flashes and turns back when he is bumped
'   orb run tests/bench/programs/measured/prison.bas --for 60s --lines-per-second 1000000 --stimulus tests/bench/programs/bumps.stimulus
10 T=90
20 for S=1 to 14
30 if A=0 then RGB 0,128,0 else RGB 255,1/A*255,0
40 backLED A*80
50 goroll D,60+20*A,1
60 for K=1 to 10
70 delay 100
80 if abs accelX>2000 or abs accelY>2000 then K=20
90 next K
100 if K<20 then goto 240
110 goroll D,0,0
120 B=B+1
130 if A<3 then A=A+1
140 print "halt",B,"alarm",A
150 for K=1 to A
160 RGB 255,255,255
170 delay 80
180 RGB 0,0,0
190 delay 80
200 next K
210 T=360-T
220 D=(D+180)%360
230 goto 260
240 if A>0 then A=A-1
250 D=(D+T)%360
260 next S
270 goroll D,0,0
280 print "off duty after",B,"bumps"
