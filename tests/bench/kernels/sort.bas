10 S = 7
20 for R = 1 to 3000
30 for Y = 1 to 25
40 S = (S * 75 + 74) % 65537
50 Z = S
60 next Y
70 for I = 2 to 25
80 Y = I
90 V = Z
100 J = I - 1
110 Y = J
120 W = Z
130 if W < V then goto 190
140 Y = J + 1
150 Z = W
160 J = J - 1
170 if J > 0 then goto 110
190 Y = J + 1
200 Z = V
210 next I
220 Y = 13
230 T = (T + Z) % 65537
240 next R
250 print T
