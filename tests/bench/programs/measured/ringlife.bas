' ringlife.bas: the Game of Life on a ring of 20 cells, each with two neighbours on either side
'   orb run tests/bench/programs/measured/ringlife.bas --for 60s --seed 2 --lines-per-second 1000000
10 for Y=1 to 20
20 Z=rnd 2
30 next Y
40 for G=1 to 16
50 P=0
60 for Y=1 to 20
70 Z=Z/2
80 print $46-11*Z;
90 P=P+Z
100 next Y
110 print ,P
120 RGB 0,P*12,40
130 if P=0 then goto 300
140 for X=1 to 20
150 Y=(X+17)%20+1
160 N=Z&1
170 Y=Y%20+1
180 N=Z&1+N
190 Y=X%20+1
200 N=Z&1+N
210 Y=Y%20+1
220 N=Z&1+N
230 Y=X
240 Z=(24+16*Z)}N&2+Z
250 next X
260 delay 300
270 next G
280 print "alive after 16"
290 end
300 RGB 255,0,0
310 print "died out in",G
