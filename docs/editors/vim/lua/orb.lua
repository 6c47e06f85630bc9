-- Starts `orb lsp` for the present buffer, one server for all of them, and knows what its code lenses
-- ask for. Settings, before the first file is opened:
--   vim.g.orb_path = '/path/to/orb'   vim.g.orb_target = '1.2'

local M = {}
local client

local function path()
  return vim.g.orb_path or 'orb'
end

-- Neovim loses what a program writes to its terminal just before it ends (neovim issue 37982): let it end later.
local function ending_later(command)
  return vim.list_extend({ 'sh', '-c', '"$@"; code=$?; sleep 0.1; exit $code', 'sh' }, command)
end

-- Runs `orb` with these arguments in a terminal below.
local function in_terminal(arguments)
  vim.cmd('silent! update')
  vim.cmd('botright 12split')
  vim.cmd('enew')
  vim.fn.termopen(ending_later(vim.list_extend({ path() }, arguments)))
end

local function debug(launch)
  require('dap').run(vim.tbl_extend('force', { type = 'orb', request = 'launch', name = 'orb' }, launch))
end

local function file_of(command)
  return vim.uri_to_fname(command.arguments[1])
end

-- The commands of the code lenses: `:lua vim.lsp.codelens.run()` on a line that has some.
local commands = {
  ['orb.run'] = function(command) in_terminal({ 'run', file_of(command) }) end,
  ['orb.debug'] = function(command) debug({ program = file_of(command), stopOnEntry = true }) end,
  ['orb.runTest'] = function(command)
    local name = command.arguments[2]
    in_terminal({ 'test', file_of(command), unpack(name ~= '' and { '--only', name } or {}) })
  end,
  ['orb.debugTest'] = function(command)
    debug({ test = file_of(command), testName = command.arguments[2], stopOnEntry = true })
  end,
}

-- For the plugin nvim-dap: the adapter `orb dap`, and to debug the file in front.
function M.dap()
  local dap = require('dap')
  dap.adapters.orb = { type = 'executable', command = path(), args = { 'dap' } }
  for _, language in ipairs({ 'orbbasic', 'orbstructured', 'orbmacro' }) do
    dap.configurations[language] = {
      { type = 'orb', request = 'launch', name = 'from the first line', program = '${file}', stopOnEntry = true },
      { type = 'orb', request = 'launch', name = 'to its end, to go back from there', program = '${file}', stopAtEnd = true },
    }
  end
end

function M.start()
  if vim.fn.executable(path()) == 0 then
    return
  end
  for name, run in pairs(commands) do
    vim.lsp.commands[name] = run
  end
  local config = {
    name = 'orb',
    cmd = { path(), 'lsp' },
    root_dir = vim.fn.getcwd(),
    init_options = { target = vim.g.orb_target or '' },
  }
  if vim.lsp.start then
    vim.lsp.start(config)
    return
  end
  -- Neovim before 0.8
  client = client or vim.lsp.start_client(config)
  vim.lsp.buf_attach_client(0, client)
end

return M
