' Noughts and crosses: two players take free fields at random until one has a row or all are taken.
'   orb run tests/bench/programs/looked/oxo.bas --seed 3
10 P = 1
20 Y = rnd 9
30 if Z > 0 then goto 20
40 Z = P
50 M = M + 1
55 D = 3
60 for I = 1 to 3
70 Y = I
80 gosub 300
85 next I
87 D = 1
90 for I = 1 to 7 step 3
92 Y = I
94 gosub 300
96 next I
98 D = 4
100 Y = 1
102 gosub 300
104 D = 2
106 Y = 3
108 gosub 300
110 if W > 0 then goto 170
120 P = 3 - P
130 if M < 9 then goto 20
140 print "nobody wins"
150 goto 180
170 print "player", P, "wins after", M
180 for Y = 1 to 9
190 if Z = 0 then print ".";
200 if Z = 1 then print "x";
210 if Z = 2 then print "o";
220 if Y % 3 = 0 then print ""
230 next Y
240 end
300 A = Z
310 Y = Y + D
320 if A = 0 or Z ! A then return
330 Y = Y + D
340 if Z = A then W = 1
350 return
