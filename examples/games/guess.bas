' Guess the number: the ball thinks of a number from 1 to 50, you send your guesses.
'   orb run examples/games/guess.bas --seed 3 --input 25,12,18,21,19
10 N = rnd 50
20 G = 0
30 print "your guess (1 to 50)?"
40 input X
50 G = G + 1
60 if X = N then goto 120
70 if X < N then LEDC 3 else LEDC 1
80 if X < N then print X " is too low" else print X " is too high"
90 if G < 6 then goto 30
100 print "it was", N
110 end
120 print "yes! in", G " tries"
130 for F = 1 to 7
140 LEDC F
150 delay 150
160 next F
