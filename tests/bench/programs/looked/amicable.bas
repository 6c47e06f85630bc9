' Numbers: which are perfect, abundant, happy, and which are the sum of two squares.
'   orb run tests/bench/programs/looked/amicable.bas --lines-per-second 1000000 --for 60s
10 for K = 2 to 60
20 S = 1
30 D = 2
40 if D > K / 2 then goto 80
50 if K % D = 0 then S = S + D
60 D = D + 1
70 goto 40
80 if S = K then goto 110
90 if S > K then B = B + 1 else C = C + 1
100 goto 130
110 print K, "is perfect"
120 A = A + 1
130 N = K
140 if N = 1 then goto 220
150 if N = 4 then goto 280
160 S = 0
170 S = S + N % 10 * (N % 10)
180 N = N / 10
190 if N > 0 then goto 170
200 N = S
210 goto 140
220 H = H + 1
230 I = 1
240 S = K - I * I
245 if S < 0 then goto 280
250 if (sqrt S) * (sqrt S) = S then goto 270
255 I = I + 1
260 goto 240
270 print K, "is happy and square"
280 next K
290 print A, B, C, "happy", H
