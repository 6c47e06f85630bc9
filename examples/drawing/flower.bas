' Flower: six petals; each is a curve out and a curve back, with a sharp turn at its tip.
'   orb run examples/drawing/flower.bas --svg flower.svg
10 for P = 0 to 5
20 A = P * 60 + 315
30 gosub 100
40 A = P * 60 + 135
50 gosub 100
60 next P
70 RGB 0,160,0
80 end
' a quarter of a circle that begins along A, the colour runs along it
100 goroll A % 360,0,1
110 delay 350
120 for T = 0 to 9
130 RGB 255,T * 20,60 + P * 35
140 goroll (A + T * 10) % 360,80,1
150 delay 110
160 next T
170 goroll (A + 90) % 360,0,0
180 delay 450
190 return
