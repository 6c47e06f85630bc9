-- Run by grammars_test inside Neovim: the words of a text, each with the last colour it gets.

local failures = 0

local function expect(language, lines, wanted)
  vim.cmd('enew!')
  vim.api.nvim_buf_set_lines(0, 0, -1, false, lines)
  local parser = vim.treesitter.get_parser(0, language)
  local root = parser:parse()[1]:root()
  if root:has_error() then
    failures = failures + 1
    io.stdout:write(language .. ': ' .. root:sexpr() .. '\n')
  end
  local read = vim.treesitter.query and vim.treesitter.query.get or require('vim.treesitter.query').get_query
  local text = require('vim.treesitter.query').get_node_text or vim.treesitter.get_node_text
  local query = read(language, 'highlights')
  local order, colours = {}, {}
  for id, node in query:iter_captures(root, 0, 0, -1) do
    local row, column = node:start()
    local place = string.format('%03d:%03d', row, column)
    if not colours[place] then
      table.insert(order, place)
    end
    colours[place] = text(node, 0) .. ':' .. query.captures[id]
  end
  table.sort(order)
  local seen = {}
  for _, place in ipairs(order) do
    table.insert(seen, colours[place])
  end
  seen = table.concat(seen, ' ')
  vim.treesitter.highlighter.new(parser) -- as the docs say for old versions
  vim.cmd('redraw')
  if seen ~= wanted then
    failures = failures + 1
    io.stdout:write(language .. '\n  wanted ' .. wanted .. '\n  seen   ' .. seen .. '\n')
  end
end

vim.opt.runtimepath:prepend(vim.fn.getcwd() .. '/orb')

expect('orbbasic', { "20 if speed < 5 then goto 10 else RGB 1,2,3 'red" },
  "20:label if:keyword speed:variable.builtin <:operator 5:number then:keyword goto:keyword 10:label "
    .. "else:keyword RGB:function.builtin 1:number 2:number 3:number 'red:comment")
expect('orbstructured', { 'sub leg(n)', '  goroll n * 90, 80, 1', 'end sub', 'Leg(min(2,', '  yaw))' },
  'sub:keyword leg:function n:parameter goroll:function.builtin n:variable *:operator 90:number 80:number '
    .. '1:number end:keyword sub:keyword Leg:function min:function.builtin 2:number yaw:variable.builtin')
expect('orbmacro', { '.macro wink id=40 flags=endsig', 'roll speed=128, 90 # go' },
  '.macro:keyword wink:variable id:parameter =:operator 40:number flags:parameter =:operator '
    .. 'endsig:constant.builtin roll:function.builtin speed:parameter =:operator 128:number 90:number # go:comment')

io.stdout:write(failures == 0 and 'ok\n' or '')
vim.cmd(failures == 0 and 'qa!' or 'cq!')
