' narciss.bas: finds the narcissistic numbers up to 9999, such as 153 = 1*1*1 + 5*5*5 + 3*3*3
'   orb run tests/bench/programs/measured/narciss.bas --for 60s --lines-per-second 1000000
10 L=1
20 for D=1 to 4
30 for Y=1 to 10
40 if D=1 then Z=Y-1 else Z=Z*(Y-1)
50 next Y
60 for N=L to L*10-1
70 S=0
80 R=N
90 Y=R%10+1
100 S=S+Z
110 R=R/10
120 if R>0 then goto 90
130 if S!N then goto 190
140 F=F+1
150 R=sqrt 8*N+1
160 R=R*R-8*N
170 if R=1 then RGB 0,0,255 else RGB 0,128,0
180 if R=1 then print N,"is triangular, too" else print N
190 next N
200 print "digits:",D,"found:",F
210 L=L*10
220 next D
