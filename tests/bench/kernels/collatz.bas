10 M = 0
20 for N = 1 to 20000
30 X = N
40 L = 0
50 if X % 2 = 0 then X = X / 2 else X = 3 * X + 1
60 L = L + 1
70 if X > 1 then goto 50
80 if L > M then M = L
90 next N
100 print M
