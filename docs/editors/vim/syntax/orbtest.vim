" tests of programs for Sphero robots
" Printed by `orb spec --editors docs/editors`; a test compares them.
if exists('b:current_syntax')
  finish
endif
syntax case match
syntax keyword orbtestKeyword program ball with course target firmware area seeds
syntax keyword orbtestKeyword for test expect reach never within at during
syntax keyword orbtestKeyword and after before to times facing points by
syntax keyword orbtestKeyword macro end
syntax keyword orbtestExpectation print prints near beyond inside stay heading speed
syntax keyword orbtestExpectation moving resting distance color backled marker collision error
syntax keyword orbtestExpectation asleep end lines bytes
syntax keyword orbtestStimulus wall shake toss push roll rgb connect disconnect
syntax keyword orbtestStimulus battery charger input tilt spin noise
syntax match orbtestNumber /[-+]\?\<\d\+\(\.\d\+\)\?\(ms\|s\|min\|mm\|cm\|m\|deg\)\?\>/
syntax match orbtestComment /#.*$/
syntax match orbtestNumber /#\x\{6}\>/
syntax region orbtestString start=/"/ end=/"/ oneline
syntax region orbtestString start=+\%(print \)\@<=/+ skip=+\\/+ end=+/+ oneline
highlight default link orbtestKeyword Conditional
highlight default link orbtestExpectation Statement
highlight default link orbtestStimulus Function
highlight default link orbtestNumber Number
highlight default link orbtestString String
highlight default link orbtestComment Comment
let b:current_syntax = 'orbtest'
