' Bakery: people queue in a ring of eight places, one is served every third minute, some find it full.
'   orb run tests/bench/programs/looked/bakery.bas --seed 11
10 F = 1
20 N = 1
30 for M = 1 to 40
40 P = rnd 3
50 P = P - 1
60 if P = 0 then goto 160
70 P = P - 1
80 if W < 8 then goto 110
90 L = L + 1
100 goto 60
110 Y = F + W
120 if Y > 8 then Y = Y - 8
130 Z = N
140 N = N + 1
145 W = W + 1
150 if W > G then G = W
155 goto 60
160 if M % 3 > 0 then goto 230
170 if W = 0 then print "idle at", M
180 if W = 0 then goto 230
190 Y = F
200 F = F % 8 + 1
205 W = W - 1
210 S = S + 1
220 print "minute", M, "serves", Z
230 next M
240 print S, "served,", L, "lost, longest", G
