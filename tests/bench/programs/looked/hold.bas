' Twenty-one: draws cards, counts an ace high while that fits, and plays five rounds against a bank.
'   orb run tests/bench/programs/looked/hold.bas --seed 8
10 for R = 1 to 5
20 S = 17
30 gosub 200
40 M = T
50 if M < 22 then goto 80
60 print "round", R, "bust with", M
70 goto 160
80 S = 16
90 gosub 200
100 print "round", R, M, "to", T;
110 if T < 22 and M < T + 1 then goto 140
120 W = W + 1
125 print " won"
130 goto 160
140 if M = T then D = D + 1
150 if M = T then print " drawn" else print " lost"
160 next R
170 print W, "won,", D, "drawn"
180 end
200 T = 0
205 A = 0
210 C = rnd 13
220 if C > 10 then C = 10
230 if C = 1 then C = 11
240 if C = 11 then A = A + 1
250 T = T + C
260 if T < 22 or A = 0 then goto 290
270 T = T - 10
280 A = A - 1
290 if T < S then goto 210
300 return
