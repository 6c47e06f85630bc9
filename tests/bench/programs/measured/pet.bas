' Keeps a pet that gets hungry and sleepy: shake it to feed it, but let it sleep when it sleeps
'   orb run tests/bench/programs/measured/pet.bas --for 60s --stimulus tests/bench/programs/shakes.stimulus --lines-per-second 1000000
' the mood M is the colour, too: 0 asleep, 1 hungry, 2 happy; H is 10 at most
10 H = 2
20 E = 12
30 for T = 1 to 60
40 E = E-1+S*3
50 if E = 0 or E > 11 then S = 1-S
60 if T%3 = 0 then H = H+1
70 if dshake = 0 then goto 110
80 H = H+S*4-4
90 if H < 0 then H = 0
100 if S = 1 then print "grrr, let me sleep" else print "yum, hunger is now",H
110 M = (2-H/7)*(1-S)
120 if M = L then goto 180
130 LEDC M
140 if M = 0 then print "zzz"
150 if M = 1 then print "I am hungry"
160 if M = 2 then print "I am happy"
170 L = M
180 if H > 9 then goto 220
190 backLED E*20
200 delay 400
210 next T
220 print "it lived for",T" moments"
