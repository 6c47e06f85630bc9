' Tint: a filter for colours. Whatever colour the client asks for, the ball shows its complement.
'   orb run examples/senses/tint.bas --stimulus examples/senses/tint.stimulus --for 6s
10 if cmdrgb = 0 then goto 40
20 RGB 255 - redval,255 - grnval,255 - bluval
30 print "asked:", redval, grnval, bluval
40 delay 50
50 goto 10
