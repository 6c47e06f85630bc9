' Packs a row of colours as runs, lists the runs, unpacks them to the light and compares the result with the row.
'   orb run tests/bench/programs/rethought/runlength.bas --for 60s
10 data 1,1,1,4,4,7,7,7,7,2,3,3,3,5,5,5,5,5,5,6,0,0,1,1
20 Y = 1
30 read Z
40 Z = Z + 10                              ' Z: 10 * length + colour
50 for I = 2 to 24
60 read C
70 if C = Z % 10 then Z = Z + 10 else Y = Y + 1
80 if Z = 0 then Z = C + 10                ' a new run
90 next I
100 R = Y
110 for Y = 1 to R
120 print Z / 10 " x " Z % 10
130 if Z > L then L = Z
140 next Y
150 print R, "runs, the longest has", L / 10
160 print "24 numbers became", R * 2
170 rstr
180 for Y = 1 to R
190 LEDC Z % 10
200 for I = 1 to Z / 10
210 delay 150
220 read C
230 if C ! Z % 10 then E = E + 1
240 next I
250 next Y
260 if E = 0 then print "all colours match" else print E, "errors"
270 LEDC 0
