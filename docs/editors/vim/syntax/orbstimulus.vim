" what the world does to a Sphero robot
" Printed by `orb spec --editors docs/editors`; a test compares them.
if exists('b:current_syntax')
  finish
endif
syntax case match
syntax keyword orbstimulusKeyword at
syntax keyword orbstimulusEvent wall shake toss push roll rgb connect disconnect
syntax keyword orbstimulusEvent battery charger input tilt spin noise
syntax keyword orbstimulusValue on off
syntax match orbstimulusNumber /[-+]\?\<\d\+\(\.\d\+\)\?\(ms\|s\|min\)\?\>/
syntax match orbstimulusComment /#.*$/
highlight default link orbstimulusKeyword Conditional
highlight default link orbstimulusEvent Function
highlight default link orbstimulusValue Constant
highlight default link orbstimulusNumber Number
highlight default link orbstimulusComment Comment
let b:current_syntax = 'orbstimulus'
