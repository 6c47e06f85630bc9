-- Starts `orb lsp` for the present buffer, one server for all of them. Settings, before the first
-- file is opened:  vim.g.orb_path = '/path/to/orb'   vim.g.orb_target = '1.2'

local M = {}
local client

function M.start()
  local path = vim.g.orb_path or 'orb'
  if vim.fn.executable(path) == 0 then
    return
  end
  local config = {
    name = 'orb',
    cmd = { path, 'lsp' },
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
