-- Run by neovim_test inside Neovim.

local failures = 0

local function check(what, good, seen)
  if not good then
    failures = failures + 1
    io.stdout:write('failed: ' .. what .. ': ' .. vim.inspect(seen) .. '\n')
  end
end

local function write(name, lines)
  vim.fn.writefile(lines, name)
  vim.cmd('edit ' .. name)
end

local patience_ms = 10000

-- Waits until the findings of the buffer are those of these rules.
local function expect_findings(what, rules)
  local function codes()
    local found = {}
    for _, one in ipairs(vim.diagnostic.get(0)) do
      -- Neovim 0.7 keeps the code with the protocol's own data.
      local code = one.code or (one.user_data and one.user_data.lsp and one.user_data.lsp.code)
      table.insert(found, code or '?')
    end
    table.sort(found)
    return found
  end
  vim.wait(patience_ms, function() return vim.deep_equal(codes(), rules) end, 10)
  check(what, vim.deep_equal(codes(), rules), codes())
end

local function attached()
  return vim.wait(patience_ms, function()
    local client = vim.lsp.buf_get_clients(0)
    return next(client) ~= nil and select(2, next(client)).initialized
  end, 10)
end

local function ask(method, line, character, more)
  local params = vim.tbl_extend('force', {
    textDocument = vim.lsp.util.make_text_document_params(0),
    position = { line = line, character = character },
  }, more or {})
  local answers = vim.lsp.buf_request_sync(0, 'textDocument/' .. method, params, patience_ms)
  local _, answer = next(answers or {})
  return answer and answer.result
end

local function buffer()
  return vim.api.nvim_buf_get_lines(0, 0, -1, false)
end

local function apply(edit)
  local client = select(2, next(vim.lsp.buf_get_clients(0)))
  vim.lsp.util.apply_workspace_edit(edit, client.offset_encoding)
end

local function has_label(items, label)
  for _, item in ipairs(items or {}) do
    if item.label == label then return true end
  end
  return false
end

-- orbBasic

write('square.bas', { '10 rgb 255,0,0', '20 delay 100', '30 goto 20' })
check('file type', vim.bo.filetype == 'orbbasic', vim.bo.filetype)
check('colours', vim.b.current_syntax == 'orbbasic', vim.b.current_syntax)
check('the server starts', attached(), vim.lsp.buf_get_clients(0))
expect_findings('findings on opening', { 'unknown-statement' })

local actions = ask('codeAction', 0, 3, {
  range = { start = { line = 0, character = 4 }, ['end'] = { line = 0, character = 4 } },
  context = { diagnostics = {}, only = { 'quickfix' } },
})
check('a fix is offered', actions and #actions == 1, actions)
apply(actions[1].edit)
check('the fix is made', buffer()[1] == '10 RGB 255,0,0', buffer())
expect_findings('no finding after the fix', {})

vim.api.nvim_buf_set_lines(0, 3, 3, false, { '40 foo "é😀" ', '50 end' })
expect_findings('findings as one types', { 'nonprinting-byte', 'unknown-statement' })
vim.api.nvim_buf_set_lines(0, 3, 5, false, {})
expect_findings('and gone again', {})

local hover = ask('hover', 1, 4)
check('hover', hover and hover.contents.value:find('delay', 1, true), hover)
check('completion of targets', has_label((ask('completion', 2, 8) or {}).items, '20'), 'no 20')
local definition = ask('definition', 2, 9)
check('definition', definition and definition[1].range.start.line == 1, definition)
local references = ask('references', 1, 0, { context = { includeDeclaration = true } })
check('references', references and #references == 2, references)
apply(ask('rename', 2, 9, { newName = '25' }))
check('rename', vim.deep_equal(buffer(), { '10 RGB 255,0,0', '25 delay 100', '30 goto 25' }), buffer())
local symbols = ask('documentSymbol', 0, 0)
check('symbols', symbols and #symbols == 1 and symbols[1].name == '25', symbols)
vim.api.nvim_buf_set_lines(0, 0, 1, false, { '10    RGB 255, 0, 0' })
local edits = ask('formatting', 0, 0, { options = { tabSize = 2, insertSpaces = true } })
vim.lsp.util.apply_text_edits(edits, 0, 'utf-16')
check('formatting', buffer()[1] == '10 RGB 255,0,0', buffer())

-- macros

write('dance.macro', { '.macro dance id=40', 'rol 128, 90', 'goto dance' })
check('file type', vim.bo.filetype == 'orbmacro', vim.bo.filetype)
check('one server for both', attached(), vim.lsp.buf_get_clients(0))
expect_findings('findings in a macro', { 'macro-unknown-command' })
vim.api.nvim_buf_set_lines(0, 1, 2, false, { 'roll 128, 90, delay=200ms' })
expect_findings('none after mending', {})
check('completion of commands', has_label((ask('completion', 1, 1) or {}).items, 'roll'), 'no roll')
local back = ask('definition', 2, 6)
check('definition of a macro', back and back[1] and back[1].range.start.line == 0, back)

-- lenses

local lenses = ask('codeLens', 0, 0)
check('lenses', lenses and #lenses == 2 and lenses[1].command.command == 'orb.run', lenses)
check('the lens has a command', type(vim.lsp.commands['orb.run']) == 'function', vim.lsp.commands)
vim.lsp.commands['orb.run']({ arguments = { vim.uri_from_bufnr(0) } })
local shown = vim.wait(patience_ms, function()
  return table.concat(buffer(), '\n'):find('robot time', 1, true) ~= nil
end, 10)
check('the run is shown', shown, buffer())
vim.cmd('bwipeout!')

vim.lsp.stop_client(vim.lsp.get_active_clients())
check('the server ends', vim.wait(patience_ms, function() return #vim.lsp.get_active_clients() == 0 end, 10))

-- the debugger, through a client of our own: nvim-dap speaks the same protocol

local dap = dofile(vim.env.TESTS .. '/dap_client.lua')
local session = dap.start(vim.env.ORB)
vim.fn.writefile({ '10 A = 1', '20 B = A + 1', '30 A = B * 7', '40 end' }, 'steps.bas')
check('initialize', session.ask('initialize', { adapterID = 'orb', linesStartAt1 = true }).success, 'no')
local launched = session.tell('launch', { program = vim.fn.getcwd() .. '/steps.bas', stopAtEnd = true })
check('initialized', session.wait('initialized') ~= nil, 'no event')
local points = session.ask('setBreakpoints', {
  source = { path = vim.fn.getcwd() .. '/steps.bas' }, breakpoints = { { line = 3 } },
})
check('a breakpoint', points.success and points.body.breakpoints[1].verified, points)
session.ask('configurationDone')
check('launch', session.answer(launched).success, session.answer(launched))
local function where()
  local trace = session.ask('stackTrace', { threadId = 1 })
  return trace.success and trace.body.stackFrames[1] and trace.body.stackFrames[1].line
end
local function value_of(name)
  local frame = session.ask('stackTrace', { threadId = 1 }).body.stackFrames[1]
  local answer = session.ask('evaluate', { expression = name, frameId = frame.id, context = 'watch' })
  return answer.success and answer.body.result or answer.message
end
local stopped = session.wait('stopped')
check('it stops there', stopped and stopped.reason == 'breakpoint' and where() == 3, { stopped, where() })
check('a value', value_of('B') == '2', value_of('B'))
check('a step', session.ask('next', { threadId = 1 }).success and session.wait('stopped') and where() == 4, where())
check('the new value', value_of('A') == '14', value_of('A'))
check('a step back', session.ask('stepBack', { threadId = 1 }).success and session.wait('stopped') and where() == 3, where())
check('the old value', value_of('A') == '1', value_of('A'))
session.ask('disconnect')
check('the debugger ends', session.ended() and session.code == 0, session.code)

-- what the plugin gives nvim-dap

package.loaded.dap = { adapters = {}, configurations = {} }
require('orb').dap()
local given = package.loaded.dap
check('adapter', vim.deep_equal(given.adapters.orb, { type = 'executable', command = vim.g.orb_path, args = { 'dap' } }), given.adapters)
check('configurations', given.configurations.orbstructured[1].program == '${file}', given.configurations)

vim.cmd(failures == 0 and 'qall!' or 'cquit!')
