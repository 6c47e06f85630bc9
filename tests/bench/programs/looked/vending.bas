' Vending machine: coins come as numbers, a drink costs 150; change and out of stock are its states.
'   orb run tests/bench/programs/looked/vending.bas --lines-per-second 1000000 --for 60s
10 data 50,100,20,20,20,100,5,200,10,50,50,50,20,100,0
20 S = 3
30 if P = 0 then RGB 0,0,255 else RGB 255,160,0
40 read C
50 if C = 0 then goto 190
60 if C = 10 or C = 20 then goto 100
65 if C = 50 or C = 100 then goto 100
70 if C = 200 then goto 100
80 print "not taken:", C
90 goto 120
100 N = N + 1
110 P = P + C
120 delay 50
130 if P < 150 then goto 30
140 RGB 0,255,0
150 print "drink, change", P - 150
155 P = 0
160 S = S - 1
170 delay 300
180 if S > 0 then goto 200
190 delay 50
195 RGB 255,0,0
197 print N, "coins,", S, "left,", P, "lost"
198 end
200 delay 50
210 goto 30
