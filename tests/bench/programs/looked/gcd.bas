' Greatest common divisors: a small table, counts the pairs that are coprime, and a sum of fractions.
'   orb run tests/bench/programs/looked/gcd.bas
10 for A = 2 to 6
20 for B = 2 to 6
30 G = A
40 H = B
50 gosub 300
60 print G, "";
70 if G = 1 then C = C + 1
80 next B
90 print ""
100 next A
110 print "coprime:", C
120 T = 1
130 B = 2
140 for N = 3 to 5
150 T = T * N + B
160 B = B * N
170 G = T
180 H = B
190 gosub 300
200 if G > 1 then LEDC 2 else LEDC 3
210 T = T / G
220 B = B / G
230 next N
240 print T "/" B
250 end
300 I = G % H
310 G = H
320 H = I
330 if H > 0 then goto 300
340 return
