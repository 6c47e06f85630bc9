#include "base/duration.h"

#include "base/text/text.h"

#include <array>
#include <fmt/format.h>

namespace orb {
namespace {

struct Unit {
  std::string_view word;
  Duration length;
};

// Longer words first where one ends in another.
constexpr auto units = std::to_array<Unit>({{"ms", 1ms}, {"min", 1min}, {"s", 1s}, {"h", 1h}});
constexpr Duration longest = 8784h;

/// Takes the unit off the end of `text`; zero where there is none.
Duration take_unit(std::string_view& text) {
  for (const auto& unit : units)
    if (text.ends_with(unit.word)) {
      text.remove_suffix(unit.word.size());
      return unit.length;
    }
  return {};
}

} // namespace

std::optional<Duration> parse_duration(std::string_view text, Duration bare) {
  auto unit = take_unit(text);
  if (unit == Duration{})
    unit = bare;
  if (unit == Duration{} || text.empty() || !is_digit(text.front()))
    return std::nullopt;
  Duration time{};
  std::size_t at = 0;
  for (; at < text.size() && is_digit(text[at]); ++at) {
    time = time * 10 + unit * (text[at] - '0');
    if (time > longest)
      return std::nullopt;
  }
  if (at < text.size() && text[at] == '.')
    for (++at; at < text.size() && is_digit(text[at]); ++at) {
      unit /= 10;
      time += unit * (text[at] - '0');
    }
  return at == text.size() ? std::optional(time) : std::nullopt;
}

std::string time_text(std::int64_t ms) {
  constexpr std::int64_t second = 1s / 1ms;
  return ms % second == 0 ? fmt::format("{}s", ms / second) : fmt::format("{}ms", ms);
}

} // namespace orb
