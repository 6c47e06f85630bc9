' prints the numbers that the user types as roman numerals, until a 0 is typed
'   orb run tests/bench/programs/rethought/roman.bas --input 1994,48,3999,4000,7,0
10 input N,10000,0
20 if N = 0 then goto 290
30 if N < 0 or N > 3999 then goto 260
40 print N, "is ";
50 D = N / 1000                            ' at most 3: needs no letter for 5
60 A = 77
70 gosub 400
80 D = N / 100 % 10                        ' letters: A one, B five, C ten
90 C = A
100 B = 68
110 A = 67
120 gosub 400
130 D = N / 10 % 10
140 C = A
150 B = 76
160 A = 88
170 gosub 400
180 D = N % 10
190 C = A
200 B = 86
210 A = 73
220 gosub 400
230 print ""
240 LEDC 2
250 goto 10
260 print "no numeral for", N
270 LEDC 1
280 goto 10
290 LEDC 3
300 print "vale!"
310 end
400 if D > 4 and D < 9 then print $B;
410 on D % 5 + 1 goto 470,460,450,440,420
420 if D = 9 then print $A $C; else print $A $B;
430 return
440 print $A;
450 print $A;
460 print $A;
470 return
