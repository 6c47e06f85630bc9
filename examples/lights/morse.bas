' Morse: blinks ORB. One number per letter, its digits are 1 for a dot and 2 for a dash.
'   orb run examples/lights/morse.bas
10 U = 120
20 data 222,121,2111
30 for L = 1 to 3
40 read C
50 M = 1000
60 if C / M % 10 = 0 then goto 140
70 if C / M % 10 = 1 then print "."; else print "-";
80 RGB 255,220,120
90 if C / M % 10 = 1 then delay U else delay 3 * U
100 RGB 0,0,0
110 delay U
140 M = M / 10
150 if M > 0 then goto 60
160 print " ";
170 delay 2 * U
180 next L
190 print "sent"
