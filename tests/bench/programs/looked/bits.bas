' Bits: prints numbers in binary without leading zeros, how many ones, and whether that is even.
'   orb run tests/bench/programs/looked/bits.bas
10 for N = 0 to 255 step 17
20 W = 128
30 S = 0
40 if N & W > 0 then goto 80
50 if S = 1 then print "0";
60 goto 100
80 print "1";
90 S = 1
100 W = W / 2
110 if W > 0 then goto 40
120 if S = 0 then print "0";
130 C = 0
140 A = N
150 if A = 0 then goto 190
160 C = C + A % 2
170 A = A / 2
180 goto 150
190 print ":", C;
200 if C % 2 = 0 then print " even" else print " odd"
210 if C < M + 1 then goto 240
220 M = C
230 B = N
240 next N
250 print "most in", B
