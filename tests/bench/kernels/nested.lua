local floor = math.floor
local s = 0
for a = 1, 2000 do
  for b = 1, 1000 do
    s = s + a * b % 7
    s = s - floor(b / 3)
  end
end
print(s)
