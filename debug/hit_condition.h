#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::debug {

/// Which hits of a breakpoint count; the first is 1.
struct HitCondition {
  enum class Test : std::uint8_t { AtLeast, MoreThan, Exactly, AtMost, LessThan, Every };
  Test test = Test::AtLeast;
  std::uint64_t number = 1;

  bool holds(std::uint64_t hit) const;
  /// Parses `3` and `>= 3`, `> 3`, `== 3` and `= 3`, `<= 3`, `< 3`, or `% 3` for every third hit;
  /// an empty text means all. Fails with a sentence.
  static tl::expected<HitCondition, std::string> parse(std::string_view text);
};

} // namespace orb::debug
