; Printed by `orb spec --editors docs/editors`; a test compares them.

(name) @variable
(constant name: (name) @constant)
(sub name: (name) @function)
(function name: (name) @function)
(command name: (name) @function)
(call function: (name) @function)
(parameters (name) @parameter)
(label (name) @label)
(goto (name) @label)
["if" "for" "next" "goto" "return" "end" "const" "local" "array" "use" "include" "then" "elseif" "else" "select" "case" "while" "repeat" "until" "loop" "to" "step" "exit" "continue" "sub" "function" "and" "or" "not"] @keyword
["print" "?"] @function.builtin
(action_word) @function.builtin
(function_word) @function.builtin
(system_variable) @variable.builtin
(colour) @number
(number) @number
(string) @string
(comment) @comment
[(operator) "=" "-"] @operator
