local m = 0
for n = 1, 20000 do
  local x = n
  local l = 0
  repeat
    if x % 2 == 0 then x = x / 2 else x = 3 * x + 1 end
    l = l + 1
  until not (x > 1)
  if l > m then m = l end
end
print(m)
