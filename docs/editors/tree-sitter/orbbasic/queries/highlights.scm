; Printed by `orb spec --editors docs/editors`; a test compares them.

["then" "else" "and" "or" "to" "step" "let" "if" "for" "next" "goto" "gosub" "on"] @keyword
(control_word) @keyword
(action_word) @function.builtin
["print"] @function.builtin
"?" @function.builtin
(function_word) @function.builtin
(system_variable) @variable.builtin
(variable) @variable
(line_number) @label
(number) @number
(string) @string
(comment) @comment
[(operator) "=" "-"] @operator
