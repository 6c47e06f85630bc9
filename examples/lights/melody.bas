' Melody of colours: notes and lengths from two sets of data, played twice.
'   orb run examples/lights/melody.bas --report melody.html
10 for R = 1 to 2
20 data 1,4,2,4,3,4,1,4,1,4,2,4,3,4,1,4
30 gosub 100
40 data 3,4,4,4,7,8,3,4,4,4,7,8
50 gosub 200
60 next R
70 LEDC 0
80 end
' eight notes
100 for N = 1 to 8
110 gosub 300
120 next N
130 return
' six notes
200 for N = 1 to 6
210 gosub 300
220 next N
230 return
' one note: a colour, then a length in eighths
300 read C
310 read L
320 LEDC C
330 delay L * 75
340 LEDC 0
350 delay 40
360 return
