' Collatz: how long each number takes to come to 1, and which takes longest.
'   orb run tests/bench/programs/looked/collatz.bas --for 120s
10 for I = 1 to 20
20 N = I
30 S = 0
40 if N = 1 then goto 80
50 if N % 2 = 0 then N = N / 2 else N = N * 3 + 1
60 S = S + 1
70 goto 40
80 if S > L then goto 110
90 LEDC 0
100 goto 150
110 L = S
120 C = I
130 LEDC I % 8
140 print I, "takes", S
150 if S > 15 and I % 2 = 0 then print I, "is long and even"
160 next I
170 print "champion:", C
180 if C > 15 or L > 15 then print "big" else print "small"
