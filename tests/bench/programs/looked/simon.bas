' Simon says: shows a growing row of colours; you send them back as numbers.
'   orb run tests/bench/programs/looked/simon.bas --seed 2 --input 3,3,2,3,2,1,1 --for 60s
10 for L = 1 to 4
20 Y = L
30 Z = 1 + rnd 2
40 for Y = 1 to L
50 if Z = 3 then RGB 0,0,255
60 if Z = 2 then RGB 0,255,0
70 if Z = 1 then RGB 255,0,0
80 delay 400
90 RGB 0,0,0
100 delay 200
110 next Y
120 Y = 1
130 input A
140 if A ! Z then goto 200
150 Y = Y + 1
160 if Y < L + 1 then goto 130
170 print "well done:", L
180 next L
190 print "you won"
195 end
200 print "it was", Z
210 print "you got", L - 1
