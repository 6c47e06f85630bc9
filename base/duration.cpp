#include "base/duration.h"

#include "base/text/text.h"

#include <fmt/format.h>

namespace orb {
namespace {

constexpr Duration longest = 8784h;

} // namespace

std::optional<Duration> parse_duration(std::string_view text, Duration bare) {
  const auto amount = split_amount(text);
  const auto* const unit = find_unit(amount.rest, time_units);
  const auto per = unit != nullptr ? unit->steps : amount.rest.empty() ? bare.count() : 0;
  if (per == 0 || amount.number.empty() || !is_digit(amount.number.front()))
    return std::nullopt;
  const auto time = steps_of(amount.number, per);
  return time && time->count <= longest.count() ? std::optional(Duration(time->count))
                                                : std::nullopt;
}

std::string time_text(std::int64_t ms) {
  constexpr std::int64_t second = 1s / 1ms;
  return ms % second == 0 ? fmt::format("{}{}", ms / second, unit::s.word)
                          : fmt::format("{}{}", ms, unit::ms.word);
}

} // namespace orb
