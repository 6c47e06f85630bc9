" macros of Sphero robots
" Printed by `orb spec --editors docs/editors`; a test compares them.
if exists('b:current_syntax')
  finish
endif
syntax case match
syntax keyword orbmacroCommand end set_sd1 set_sd2 stabilization set_heading roll roll_sd1 rgb
syntax keyword orbmacroCommand rgb_sd2 back_led raw_motors delay goto gosub sleep set_spd1
syntax keyword orbmacroCommand set_spd2 roll_spd1_sd1 roll_spd2_sd1 rotation_rate fade marker wait_until_stopped rotate
syntax keyword orbmacroCommand stream_end roll2 loop_start loop_end comment rotate_sd1 rotate_sd2 on_collision
syntax keyword orbmacroCommand loop_start_system set_speed configure_collision
syntax keyword orbmacroValue motor_control exclusive_drv allow_sod inh_if_conn endsig stealth unkillable ext_flags
syntax keyword orbmacroValue off on on_without_reset forward reverse brake ignore
syntax match orbmacroDirective /^\s*\.\(macro\|const\|raw\|noend\)\>/
syntax match orbmacroOperand /\<\h\w*\ze\s*=/
syntax match orbmacroNumber /[-+]\?\<\(0[xX]\x\+\|\d\+\(\.\d\+\)\?\)\(ms\|s\|deg\)\?\>/
syntax match orbmacroEscape /\\./ contained
syntax region orbmacroString start=/"/ skip=/\\./ end=/"/ oneline contains=orbmacroEscape
syntax match orbmacroComment /#.*$/
highlight default link orbmacroCommand Statement
highlight default link orbmacroValue Constant
highlight default link orbmacroDirective PreProc
highlight default link orbmacroOperand Identifier
highlight default link orbmacroNumber Number
highlight default link orbmacroEscape SpecialChar
highlight default link orbmacroString String
highlight default link orbmacroComment Comment
let b:current_syntax = 'orbmacro'
