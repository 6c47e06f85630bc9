10 S = 0
20 for I = 1 to 300000
30 A = I
40 gosub 100
50 next I
60 print S
70 end
100 A = A + 1
110 gosub 200
120 gosub 300
130 return
200 S = S + A & 1023
210 gosub 300
220 return
300 S = S + 3
310 return
