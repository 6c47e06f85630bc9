local band = bit.band
local s, a = 0, 0
local function three()
  s = s + 3
end
local function two()
  s = band(s + a, 1023)
  three()
end
local function one()
  a = a + 1
  two()
  three()
end
for i = 1, 300000 do
  a = i
  one()
end
print(s)
