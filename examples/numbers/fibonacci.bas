' Fibonacci: prints the numbers that fit into 32 bits and shows each one's last six bits as a colour.
'   orb run examples/numbers/fibonacci.bas
10 A = 0
20 B = 1
30 for N = 1 to 46
40 print "F(" N ") = " B
50 RGB (B & 3) * 85,(B / 4 & 3) * 85,(B / 16 & 3) * 85
60 C = A + B
70 A = B
80 B = C
90 delay 120
100 next N
