#include "debug/hit_condition.h"

#include "base/text/text.h"
#include "base/text/utf8.h"

#include <array>
#include <fmt/format.h>

namespace orb::debug {
namespace {

struct Sign {
  std::string_view text;
  HitCondition::Test test;
};

/// Longer operators before their prefixes.
constexpr auto signs = std::to_array<Sign>({
    {">=", HitCondition::Test::AtLeast},
    {"<=", HitCondition::Test::AtMost},
    {"==", HitCondition::Test::Exactly},
    {">", HitCondition::Test::MoreThan},
    {"<", HitCondition::Test::LessThan},
    {"=", HitCondition::Test::Exactly},
    {"%", HitCondition::Test::Every},
});

} // namespace

bool HitCondition::holds(std::uint64_t hit) const {
  switch (test) {
  case Test::AtLeast: return hit >= number;
  case Test::MoreThan: return hit > number;
  case Test::Exactly: return hit == number;
  case Test::AtMost: return hit <= number;
  case Test::LessThan: return hit < number;
  case Test::Every: return hit % number == 0;
  }
  return true;
}

tl::expected<HitCondition, std::string> HitCondition::parse(std::string_view text) {
  const auto whole = trim(text);
  HitCondition condition;
  if (whole.empty())
    return condition;
  auto rest = whole;
  for (const auto& sign : signs)
    if (rest.starts_with(sign.text)) {
      condition.test = sign.test;
      rest = trim(rest.substr(sign.text.size()));
      break;
    }
  const auto number = parse_number<std::uint64_t>(rest);
  if (!number || *number == 0)
    return tl::unexpected(fmt::format("`{}` is not a hit condition; write `3` to stop from the "
                                      "third hit on, `== 3` for the third, `% 3` for every third",
                                      to_valid_utf8(whole)));
  condition.number = *number;
  return condition;
}

} // namespace orb::debug
