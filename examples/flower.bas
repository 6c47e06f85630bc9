' Flower: six petals; each is a curve out and a curve back, the LED fades along it.
'   orb run examples/flower.bas --svg flower.svg
10 for P = 0 to 5
20 for T = 0 to 17
30 RGB 255,T * 14,120 + P * 27
40 goroll (P * 60 + T * 20) % 360,80,1
50 delay 130
60 next T
70 next P
80 goroll 0,0,0
90 RGB 0,160,0
