' Battery watch: says how full the battery is and slows its blinking as it runs down.
'   orb run examples/senses/battery.bas --stimulus examples/senses/battery.stimulus --for 12s
10 V = Vbatt
20 print "battery " V / 100 "." V / 10 % 10 V % 10 " V"
30 on Sbatt goto 100,200,300,400
' charging
100 RGB 0,80,255
110 delay 2000
120 goto 10
' full enough
200 RGB 0,255,0
210 delay 100
220 RGB 0,0,0
230 delay 900
240 goto 10
' low
300 RGB 255,140,0
310 delay 300
320 RGB 0,0,0
330 delay 1700
340 goto 10
' nearly empty
400 print "charge me!"
410 RGB 255,0,0
420 delay 1500
430 goto 10
