' Rainbow: once round the colour wheel in six fades, without moving.
'   orb run examples/lights/rainbow.bas --report rainbow.html
10 for H = 0 to 1535 step 12
20 U = H % 256
30 D = 255 - U
40 on H / 256 + 1 gosub 100,120,140,160,180,200
50 delay 15
60 next H
70 end
100 RGB 255,U,0
110 return
120 RGB D,255,0
130 return
140 RGB 0,255,U
150 return
160 RGB 0,D,255
170 return
180 RGB U,0,255
190 return
200 RGB 255,0,D
210 return
