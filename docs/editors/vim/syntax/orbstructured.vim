" structured orbBasic for Sphero robots
" Printed by `orb spec --editors docs/editors`; a test compares them.
if exists('b:current_syntax')
  finish
endif
syntax case match
syntax case ignore
syntax match orbstructuredName /\<\h\w*\>/
syntax keyword orbstructuredControl then else and or to step if for
syntax keyword orbstructuredControl next goto return end const local array use
syntax keyword orbstructuredControl include elseif select case while repeat until loop
syntax keyword orbstructuredControl exit continue sub function not min max
syntax keyword orbstructuredStatement print input delay RGB LEDC backLED random goroll
syntax keyword orbstructuredStatement heading raw locate basflg data rstr read tron
syntax keyword orbstructuredStatement troff reset sleep macrun mackill
syntax keyword orbstructuredFunction sqrt rnd abs
syntax keyword orbstructuredSystem timerA timerB timerC ctrl speed yaw pitch roll
syntax keyword orbstructuredSystem accelX accelY accelZ gyroX gyroY gyroZ Vbatt Sbatt
syntax keyword orbstructuredSystem cmdroll cmdval spdval hdgval cmdrgb redval grnval bluval
syntax keyword orbstructuredSystem isconn dshake accelone xpos ypos Qzero Qone Qtwo
syntax keyword orbstructuredSystem Qthree macstat
syntax match orbstructuredNumber /#\x\{6}\>\|\<\(0x\x\+\|\d\+\(\.\d\+\)\?\(ms\|s\|min\)\?\)\>/
syntax match orbstructuredLabel /^\s*\h\w*:/
syntax match orbstructuredOperator /[-+*\/%&|{}=!<>?$]/
syntax region orbstructuredString start=/"/ end=/"/ oneline
syntax match orbstructuredComment /'.*$/
highlight default link orbstructuredControl Conditional
highlight default link orbstructuredStatement Statement
highlight default link orbstructuredFunction Function
highlight default link orbstructuredSystem Special
highlight default link orbstructuredName Identifier
highlight default link orbstructuredNumber Number
highlight default link orbstructuredLabel Label
highlight default link orbstructuredOperator Operator
highlight default link orbstructuredString String
highlight default link orbstructuredComment Comment
let b:current_syntax = 'orbstructured'
