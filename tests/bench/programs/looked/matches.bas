' Nim: take one, two or three of the sticks; who takes the last one loses. The ball plays well.
'   orb run tests/bench/programs/looked/matches.bas --seed 6 --input 2,7,3,1,2,1,2,3 --for 60s
10 S = 15
20 gosub 200
30 print "how many?"
40 input N
50 if N < 1 or N > 3 then goto 60
55 if N < S + 1 then goto 80
60 print "1, 2 or 3"
70 goto 30
80 S = S - N
90 if S = 0 then goto 170
100 gosub 200
110 N = (S - 1) % 4
120 if N = 0 then N = 1
130 print "I take", N
140 delay 300
150 S = S - N
160 if S > 0 then goto 20 else goto 180
170 print "I win"
175 RGB 255,0,0
178 end
180 print "you win"
190 RGB 0,255,0
195 end
200 print "sticks:", S
210 LEDC S % 8
220 return
