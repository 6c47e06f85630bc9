10 S = 0
20 for A = 1 to 2000
30 for B = 1 to 1000
40 S = S + A * B % 7
50 S = S - B / 3
60 next B
70 next A
80 print S
