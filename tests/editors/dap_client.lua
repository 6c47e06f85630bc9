-- A client of the Debug Adapter Protocol, as small as one can be: `local s = dap.start(orb)`, then
-- `s.ask(command, arguments)` for the answer and `s.wait(event)` for an event.

local M = {}
local patience_ms = 10000

function M.start(path)
  local loop = vim.loop
  local into, from = loop.new_pipe(false), loop.new_pipe(false)
  local session = { code = nil }
  local buffer, answers, events, last = '', {}, {}, 0
  local process = loop.spawn(path, { args = { 'dap' }, stdio = { into, from, nil } },
    function(code) session.code = code end)

  local function take()
    while true do
      local head_end, body = buffer:find('\r\n\r\n', 1, true)
      local length = head_end and tonumber(buffer:sub(1, head_end):match('Content%-Length: (%d+)'))
      if not length or #buffer < body + length then return end
      local message = vim.json.decode(buffer:sub(body + 1, body + length))
      buffer = buffer:sub(body + length + 1)
      if message.type == 'response' then
        answers[message.request_seq] = message
      elseif message.type == 'event' then
        table.insert(events, message)
      end
    end
  end
  from:read_start(vim.schedule_wrap(function(_, bytes)
    if bytes then
      buffer = buffer .. bytes
      take()
    end
  end))

  function session.tell(command, arguments)
    last = last + 1
    local text = vim.json.encode({
      seq = last, type = 'request', command = command,
      arguments = arguments or vim.empty_dict(),
    })
    into:write(('Content-Length: %d\r\n\r\n%s'):format(#text, text))
    return last
  end
  function session.answer(seq)
    vim.wait(patience_ms, function() return answers[seq] ~= nil end, 5)
    return answers[seq] or { success = false, message = 'no answer' }
  end
  function session.ask(command, arguments)
    return session.answer(session.tell(command, arguments))
  end
  -- The next event of that kind that has not been waited for yet.
  function session.wait(event)
    local found
    vim.wait(patience_ms, function()
      for i, one in ipairs(events) do
        if one.event == event then
          found = table.remove(events, i)
          return true
        end
      end
      return false
    end, 5)
    return found and (found.body or {}) or nil
  end
  function session.ended()
    return vim.wait(patience_ms, function() return session.code ~= nil end, 5)
  end
  session.process = process
  return session
end

return M
