' Turns the numbers you type into binary, blinks the bits, and turns them back to check
'   orb run tests/bench/programs/measured/binary.bas --for 60s --input 5,37,1500,200,511,1,256,0
10 print "a number up to 511 (0 ends):"
20 input N,10000,0
30 if N < 1 then goto 260
40 if N > 511 then print N" is too large" else goto 60
50 goto 20
60 P = 1
70 M = N
80 D = D+M%2*P ' D is 0 here, as it was used up by the last number
90 P = P*10
100 M = M/2
110 if M > 0 then goto 80
120 print N" is",D" in binary"
130 for B = 8 to 0 step -1
140 LEDC (N}B&1)*3+3
150 delay 150
160 LEDC 0
170 delay 100
180 next B
190 P = 1
200 M = M+D%10*P ' and so is M
210 P = P*2
220 D = D/10
230 if D > 0 then goto 200
240 print "and back again",M
250 goto 20
260 print "bye"
