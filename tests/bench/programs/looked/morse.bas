' Morse: blinks words whose letters are numbers, a 1 for each dot and a 2 for each dash.
'   orb run tests/bench/programs/looked/morse.bas --lines-per-second 1000000 --for 60s
10 data 111,222,111,-1,22,1121,12,-1,121,2,0
20 W = 1
30 read S
40 if S = 0 then goto 280
50 if S > 0 then goto 100
60 W = W + 1
70 D = 240
75 print "/ ";
80 gosub 300
90 goto 30
100 N = N + 1
110 R = 0
120 R = R * 10 + S % 10
130 S = S / 10
140 if S > 0 then goto 120
150 D = R % 10 * 120 - 60
160 RGB 255,255,255
170 gosub 300
180 RGB 0,0,0
185 D = 60
190 gosub 300
200 if R % 10 = 1 then print "."; else print "-";
210 R = R / 10
220 if R > 0 then goto 150
230 D = 120
240 gosub 300
250 print " ";
260 goto 30
280 print ""
290 print N, "letters,", W, "words,", T / 1000, "seconds"
295 end
300 delay D
310 T = T + D
320 return
