' Laps: runs laps of four legs, skips the third leg of odd laps, gives up when time is short.
'   orb run tests/bench/programs/looked/laps.bas --for 120s
10 B = 130
20 for L = 1 to 5
30 for K = 1 to 4
40 if L % 2 = 1 and K = 3 then goto 90
50 if B < 20 then goto 120
60 goroll K * 90 - 90,80,1
70 delay K * 100 + 300
80 B = B - 3 - K
85 goto 100
90 S = S + 1
100 next K
110 if B > 19 then goto 150
120 print "out of time in lap", L
130 goroll 0,0,0
140 print L - 1, "laps, skipped", S
145 end
150 print "lap ", L, "left", B
160 next L
170 goroll 0,0,0
180 print "all done"
