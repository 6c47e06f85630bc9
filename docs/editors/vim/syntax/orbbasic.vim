" orbBasic, the language of Sphero robots
" Printed by `orb spec --editors docs/editors`; a test compares them.
if exists('b:current_syntax')
  finish
endif
syntax case match
syntax keyword orbbasicControl then else and or to step if for
syntax keyword orbbasicControl next goto gosub return on end
syntax keyword orbbasicStatement let print input delay RGB LEDC backLED random
syntax keyword orbbasicStatement goroll heading raw locate basflg data rstr read
syntax keyword orbbasicStatement tron troff reset sleep macrun mackill
syntax keyword orbbasicFunction sqrt rnd abs
syntax keyword orbbasicSystem timerA timerB timerC ctrl speed yaw pitch roll
syntax keyword orbbasicSystem accelX accelY accelZ gyroX gyroY gyroZ Vbatt Sbatt
syntax keyword orbbasicSystem cmdroll cmdval spdval hdgval cmdrgb redval grnval bluval
syntax keyword orbbasicSystem isconn dshake accelone xpos ypos Qzero Qone Qtwo
syntax keyword orbbasicSystem Qthree macstat
syntax match orbbasicVariable /\<\a\>/
syntax match orbbasicNumber /\<\d\+\>/
syntax match orbbasicLine /^\s*\d\+/
syntax match orbbasicOperator /[-+*\/%&|{}=!<>?$]/
syntax region orbbasicString start=/"/ end=/"/ oneline
syntax match orbbasicComment /'.*$/
highlight default link orbbasicControl Conditional
highlight default link orbbasicStatement Statement
highlight default link orbbasicFunction Function
highlight default link orbbasicSystem Special
highlight default link orbbasicVariable Identifier
highlight default link orbbasicNumber Number
highlight default link orbbasicLine Label
highlight default link orbbasicOperator Operator
highlight default link orbbasicString String
highlight default link orbbasicComment Comment
let b:current_syntax = 'orbbasic'
