' Sort: fills the indexed variables with random numbers and sorts them; the LED shows the swaps.
'   orb run examples/numbers/sort.bas --seed 7
10 for Y = 1 to 12
20 Z = rnd 99
30 next Y
40 gosub 200
50 for P = 1 to 11
60 for Y = 1 to 12 - P
70 A = Z
80 Y = Y + 1
90 B = Z
100 if A > B then gosub 300
110 Y = Y - 1
120 next Y
130 next P
140 RGB 0,255,0
150 gosub 200
160 end
' print all, four to a line
200 for Y = 1 to 12
210 print Z " ";
220 if Y % 4 = 0 then print
230 next Y
240 return
' swap A and B at Y - 1 and Y
300 Z = A
310 Y = Y - 1
320 Z = B
330 Y = Y + 1
340 RGB A * 2,0,B * 2
350 delay 60
360 return
