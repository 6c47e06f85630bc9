; Printed by `orb spec --editors docs/editors`; a test compares them.

(word) @variable
(operand name: (word) @parameter)
(directive_word) @keyword
(command_word) @function.builtin
(value_word) @constant.builtin
(number) @number
(string) @string
(comment) @comment
"=" @operator
