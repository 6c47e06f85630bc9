' Primes and twins: flashes for each prime up to a limit, prints the twins among them.
'   orb run tests/bench/programs/looked/primes.bas
10 for I = 2 to 60
20 N = I
30 gosub 200
40 if P = 0 then goto 120
50 C = C + 1
60 F = I % 4
70 if F < 1 then goto 110
75 for J = 1 to F
80 RGB 255,255,255
85 delay 20
90 RGB 0,0,0
95 delay 20
100 next J
110 if L > 0 and I - L = 2 then print L, "and", I
115 L = I
120 next I
130 print C, "primes up to", 60
140 N = C
150 gosub 200
160 if P = 1 then print "which is prime itself" else print "which is not prime"
170 end
200 P = 0
210 D = 2
220 if D * D > N then goto 260
230 if N % D = 0 then return
240 D = D + 1
250 goto 220
260 P = 1
270 return
