' Spins a roulette wheel that slows down, and bets on red until the money is gone or eight rounds are over
'   orb run tests/bench/programs/measured/roulette.bas --for 3min --seed 2
' the result C is the colour, too: 0 black, 1 red, 2 green
10 M = 20
20 for G = 1 to 8
30 W = 20+rnd 20
40 P = (P+1)%37
50 C = (P+(P-1)%18/10)%2+(37-P)/37*2
60 LEDC C
70 delay W
80 W = W*5/4+rnd 8
90 if W < 400 then goto 40
100 M = M+C%2*10-5
110 if C = 0 then print P" is black: you lose,",M" left"
120 if C = 1 then print P" is red: you win,",M" left"
130 if C = 2 then print "zero: the bank wins,",M" left"
140 if M < 5 then goto 170
150 delay 1000
160 next G
170 print "you go home with",M
