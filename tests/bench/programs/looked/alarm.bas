' Alarm: after a while it is armed; a shake rings it, three shakes or a tilt on end switch it off.
'   orb run tests/bench/programs/looked/alarm.bas --lines-per-second 1000000 --stimulus tests/bench/programs/shakes.stimulus --for 40s
10 S = S + 1
20 if S = 6 then print "armed"
30 if dshake = 0 then goto 60
40 N = N + 1
50 if S > 5 then goto 110
60 if S > 5 then RGB 0,40,0 else RGB 40,40,40
70 delay 500
80 goto 10
90 S = S + 1
95 if dshake = 1 then N = N + 1
100 goto 130
110 N = 1
120 print "who is there?"
130 RGB 255,0,0
140 delay 250
150 RGB 0,0,255
160 delay 250
170 if N > 2 or abs pitch > 60 then goto 190
180 if abs roll < 61 then goto 90
190 RGB 0,0,0
200 print "off after", S
