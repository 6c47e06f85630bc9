' Conductor: a program that runs macros and watches them by macstat.
'   orb run examples/macros/conductor.bas examples/macros/orchestra.macro
10 for M = 40 to 42
20 print "macro", M
30 macrun M
40 delay 20
50 if macstat } 16 = M then goto 40
60 next M
70 print "and bow"
