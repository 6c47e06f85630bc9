' Mirror: a remote-control filter. It keeps the driving to itself, takes the client's roll commands
' and steers the other way round at half the speed.
'   orb run examples/senses/mirror.bas --stimulus examples/senses/mirror.stimulus --for 8s --svg mirror.svg
10 basflg 1
20 if cmdroll = 0 then goto 60
30 H = (360 - hdgval) % 360
40 goroll H,spdval / 2,1
50 RGB spdval,80,255 - spdval
60 delay 50
70 goto 20
