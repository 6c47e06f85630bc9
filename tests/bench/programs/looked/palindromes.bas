' Palindromes: turns each number round and adds until it reads the same from both ends.
'   orb run tests/bench/programs/looked/palindromes.bas
10 for N = 78 to 98
20 A = N
30 C = 0
40 R = 0
50 B = A
60 R = R * 10 + B % 10
70 B = B / 10
80 if B > 0 then goto 60
90 if R = A then goto 140
100 A = A + R
110 C = C + 1
120 if C < 8 then goto 40
130 C = 99
140 if C > 0 then print N, "takes", C
150 if C > 98 or C < S + 1 then goto 180
160 S = C
170 W = N
180 next N
190 print "slowest:", W, "with", S
