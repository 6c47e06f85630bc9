' Lock: a code of four digits; three wrong ones block it, the right one opens and it counts the tries.
'   orb run tests/bench/programs/looked/lock.bas --lines-per-second 1000000 --for 60s
10 data 4,7,1,1,4,7,1,2,9,9,9,9,4,7,1,1
20 for Y = 1 to 4
30 read Z
40 next Y
50 RGB 255,160,0
60 delay 150
70 K = 0
80 for Y = 1 to 4
90 read D
100 if D ! Z then K = 1
110 next Y
120 if K = 0 then goto 190
130 W = W + 1
140 print "wrong", W
150 if W < 3 then goto 50
160 RGB 255,0,0
170 delay 150
180 print "blocked"
185 end
190 RGB 0,255,0
200 delay 150
210 print "open after", W + 1
220 backLED 255
