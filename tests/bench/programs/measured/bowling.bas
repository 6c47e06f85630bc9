' bowling.bas: reads the pins of every roll of a bowling game, ended by 99, and scores it frame by frame
'   orb run tests/bench/programs/measured/bowling.bas --for 60s --input 10,7,3,9,0,10,0,8,8,2,0,6,10,10,10,8,1,99
10 Y=Y+1
20 input Z
30 if Z<11 then goto 10
40 Z=0
50 for F=1 to 10
60 Y=F*2-N-1
70 A=Z
80 Y=Y+1
90 B=A+Z
100 Y=Y+1
110 if B>9 then S=S+Z
120 S=S+B
130 if A=10 then LEDC 5 else LEDC B/10+2
140 N=N+A/10
150 print "frame",F,"score",S
160 delay 500
170 next F
180 print N,"strikes"
190 on S/100+1 goto 200,220,240,260
200 print "keep practising"
210 end
220 print "well played"
230 end
240 print "great game"
250 end
260 print "perfect game"
