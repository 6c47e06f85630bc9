' Binary search: fills an array in rising order, then looks for eight numbers and counts the looks.
'   orb run tests/bench/programs/looked/search.bas --seed 5
10 V = 1
20 for Y = 1 to 20
30 Z = V
40 V = V + rnd 4
50 next Y
60 for N = 3 to 38 step 5
70 A = 1
80 B = 20
90 Y = (A + B) / 2
100 C = C + 1
110 if Z = N then goto 160
120 if Z < N then A = Y + 1 else B = Y - 1
130 if A < B + 1 then goto 90
140 print N, "is missing"
145 M = M + 1
150 goto 170
160 print N, "is at", Y
170 next N
180 print C, "looks,", M, "missing"
