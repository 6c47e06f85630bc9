' Finds the weekdays of some dates by Zeller's congruence, shows weekends in green, and lists when a 13th is a Friday.
'   orb run tests/bench/programs/rethought/weekday.bas --for 60s
10 data 20,7,1969,29,2,2000,31,4,1999,31,12,1999,29,2,2100,9,11,1989,24,12,2026
20 for I = 1 to 7
30 read D,M,Y
40 print D "." M "." Y ": ";
50 L = 30 + (M + M / 8) % 2 ' days in the month
60 if M ! 2 then goto 90
70 if Y % 100 = 0 then L = 400 else L = 4
80 if Y % L = 0 then L = 29 else L = 28
90 if D > L then goto 230
100 A = (M + 9) % 12 ' March is 0
110 Y = Y - A / 10
120 W = (D + 13 * (A + 4) / 5 + Y + Y / 4 - Y / 100 + Y / 400) % 7
130 on W + 1 goto 170,170,200,200,200,200,140
140 print "nearly weekend"
150 LEDC 7
160 goto 250
170 print "weekend"
180 LEDC 2
190 goto 250
200 print "working day", W - 1
210 LEDC 3
220 goto 250
230 print "no such day"
240 LEDC 1
250 delay 500
260 next I
270 for M = 1 to 12
280 A = (M + 9) % 12
290 if (2530 + 13 * (A + 4) / 5 - A / 10) % 7 = 6 then print "Friday 13." M ".2026"
300 next M
