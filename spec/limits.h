#pragma once

// Limits of the robot. The rows are in spec/limits.def.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace orb::spec {

enum class Limit : std::uint8_t {
#define ORB_LIMIT(name, value, unit, source, summary) name,
#include "spec/limits.def"
};

struct LimitInfo {
  Limit limit;
  std::string_view name;
  std::int32_t value;
  std::string_view unit; ///< may be empty
  std::string_view source;
  std::string_view summary;
};

inline constexpr auto limits = std::to_array<LimitInfo>({
#define ORB_LIMIT(name, value, unit, source, summary)                                              \
  {Limit::name, #name, value, unit, source, summary},
#include "spec/limits.def"
});

constexpr const LimitInfo& info(Limit limit) {
  return limits[static_cast<std::size_t>(limit)];
}

/// The value of a limit: `value_of(Limit::ForDepth)`.
constexpr std::int32_t value_of(Limit limit) {
  return info(limit).value;
}

/// The variables with their own letters: A, B and so on.
inline constexpr auto letter_count = static_cast<std::size_t>(value_of(Limit::DirectVariables));
constexpr char letter_name(std::size_t letter) {
  return static_cast<char>('A' + letter);
}

} // namespace orb::spec
