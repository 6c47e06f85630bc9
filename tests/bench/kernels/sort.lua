local z = {}
local s, t = 7, 0
for r = 1, 3000 do
  for y = 1, 25 do
    s = (s * 75 + 74) % 65537
    z[y] = s
  end
  for i = 2, 25 do
    local v = z[i]
    local j = i - 1
    while true do
      local w = z[j]
      if w < v then break end
      z[j + 1] = w
      j = j - 1
      if not (j > 0) then break end
    end
    z[j + 1] = v
  end
  t = (t + z[13]) % 65537
end
print(t)
