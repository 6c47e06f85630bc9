' finds the hailstone walks that are longer, or climb higher, than all before
'   orb run tests/bench/programs/rethought/hail.bas --for 60s
' S: start, V: value, C: steps, P: peak, L: longest, F: its start, H: highest
10 for S = 2 to 60
20 V = S
30 P = S
40 C = 0
50 goto 110
60 C = C + 1
70 V = 3 * V + 1
80 if V > P then P = V                     ' only an odd number climbs
90 C = C + 1                               ' and an even one follows
100 V = V / 2
110 if V & 1 = 0 then goto 90
120 if V > 1 then goto 60
130 if C < L + 1 then goto 190
140 L = C
150 F = S
160 print S, "takes", C, "steps"
170 LEDC 2
180 gosub 280
190 if P < H + 1 then goto 240
200 H = P
210 print S, "climbs to", P
220 LEDC 3
230 gosub 280
240 next S
250 print "the longest starts at", F
260 print "the highest point is", H
270 end
280 delay 200
290 LEDC 0
300 delay 100
310 return
