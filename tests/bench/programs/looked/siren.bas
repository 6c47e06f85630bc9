' Siren: the light swells and fades, faster each time, in red or blue; a shake ends it early.
'   orb run tests/bench/programs/looked/siren.bas --lines-per-second 1000000 --stimulus tests/bench/programs/shakes.stimulus --for 60s
10 R = 15
20 D = R
30 L = L + D
40 if L > 255 then L = 255
50 if L < 0 then L = 0
60 if C % 2 = 0 then RGB L,0,0 else RGB 0,0,L
70 delay 40
80 if D > 0 and L = 255 then D = 0 - R
90 if D > 0 or L > 0 then goto 130
100 C = C + 1
110 R = R + 10
120 D = R
130 if dshake = 0 or C < 3 then goto 160
145 RGB 0,0,0
147 print "stopped after", C
150 end
160 if C < 6 then goto 30
170 RGB 0,0,0
180 print "done"
