' Primes: trial division up to 100; a green flash for each prime.
'   orb run examples/numbers/primes.bas
10 C = 0
20 for N = 2 to 100
30 D = 2
40 if D * D > N then goto 100
50 if N % D = 0 then goto 140
60 D = D + 1
70 goto 40
100 C = C + 1
110 print N " ";
120 RGB 0,255,0
130 delay 30
140 RGB 0,0,0
150 delay 10
160 next N
170 print
180 print C " primes"
