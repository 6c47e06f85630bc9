' organ.bas: a light organ that fades through the colours of a palette; shake it for the next palette
'   orb run tests/bench/programs/measured/organ.bas --for 60s --lines-per-second 1000000 --stimulus tests/bench/programs/shakes.stimulus
10 gosub 300
20 for N=1 to 8
30 rstr
40 for C=1 to 4
50 read R,G,B
60 for S=1 to 8
70 RGB U+(R-U)*S/8,V+(G-V)*S/8,W+(B-W)*S/8
80 delay 60
90 next S
100 U=R
110 V=G
120 W=B
130 next C
140 print "bar",N
150 if dshake=1 then gosub 300
160 next N
170 for S=1 to 8
180 RGB U-U*S/8,V-V*S/8,W-W*S/8
190 delay 60
200 next S
210 backLED 0
220 end
300 P=P%3+1
310 backLED P*60
320 on P goto 330,360,390
330 print "fire"
340 data 255,0,0,255,128,0,255,255,0,96,0,0
350 return
360 print "sea"
370 data 0,0,255,0,128,255,0,255,200,0,0,64
380 return
390 print "forest"
400 data 0,128,0,128,255,0,64,96,16,0,32,0
410 return
