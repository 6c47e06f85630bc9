' Simulates a heated room: the heater has a hysteresis, and tilting the ball opens the window.
'   orb run tests/bench/programs/rethought/thermostat.bas --for 60s --lines-per-second 1000000 --stimulus tests/bench/programs/tilts.stimulus
10 T = 185                                 ' temperature in tenths
20 C = T                                   ' the lowest
30 H = 0 - 7                               ' 7: heats, -7: does not
40 for M = 1 to 80
50 if abs pitch > 20 or abs roll > 20 then D = 8 else D = 25
60 backLED (25 - D) * 15
70 N = N + H + 7
80 T = T - (T - 50) / D + H + 7
90 if T < C then C = T
100 if (T - 200) * H < 57 then goto 130
110 H = 0 - H
120 if H > 0 then print M ": heater on at " T / 10 "." T % 10 else print M ": heater off at " T / 10 "." T % 10
130 RGB T / 180 * (H + 7) / 14 * 255,(7 - H) / 14 * 128,255 - T / 180 * 255     ' it always heats below 180
140 delay 100
150 next M
160 print "heated for", N / 14, "minutes, coldest: ";
170 print C / 10 "." C % 10
