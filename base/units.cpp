#include "base/units.h"

#include "base/text/text.h"

#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace orb {
namespace {

constexpr auto most_steps = std::numeric_limits<std::int64_t>::max();

/// Converts `.DIGITS` to steps, `per` to one. Starts at the last digit to lose none.
Steps part_of(std::string_view digits, std::int64_t per) {
  Steps part;
  for (auto at = digits.size(); at-- > 0;) {
    const auto tenths = (digits[at] - '0') * per + part.count;
    part.count = tenths / 10;
    part.exact = part.exact && tenths % 10 == 0;
  }
  return part;
}

} // namespace

Amount split_amount(std::string_view text) {
  std::size_t end = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  const auto first = end;
  const auto skip_digits = [&] {
    while (end < text.size() && is_digit(text[end]))
      ++end;
  };
  skip_digits();
  if (end > first && end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1])) {
    ++end;
    skip_digits();
  }
  return {text.substr(0, end), text.substr(end)};
}

std::optional<Steps> steps_of(std::string_view number, std::int64_t per) {
  const auto amount = split_amount(number);
  const bool negative = number.starts_with('-');
  number.remove_prefix(negative || number.starts_with('+') ? 1 : 0);
  const auto point = std::min(number.find('.'), number.size());
  const auto whole = parse_number<std::int64_t>(number.substr(0, point));
  if (!amount.rest.empty() || !whole || *whole >= most_steps / per)
    return std::nullopt;
  auto steps = part_of(number.substr(std::min(point + 1, number.size())), per);
  steps.count += *whole * per;
  if (negative)
    steps.count = -steps.count;
  return steps;
}

std::optional<std::int64_t> hexadecimal(std::string_view text) {
  if (!text.starts_with("0x") && !text.starts_with("0X"))
    return std::nullopt;
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data() + 2, text.data() + text.size(), number, 16);
  if (read.ec == std::errc::invalid_argument || read.ptr != text.data() + text.size())
    return std::nullopt;
  return read.ec == std::errc{} && number < most_steps ? static_cast<std::int64_t>(number)
                                                       : most_steps;
}

std::string thousandths_text(std::int64_t thousandths) {
  constexpr std::int64_t one = 1000;
  auto text = fmt::format("{}{}", thousandths < 0 ? "-" : "", std::abs(thousandths) / one);
  if (const auto rest = std::abs(thousandths) % one; rest != 0) {
    text += fmt::format(".{:03}", rest);
    while (text.back() == '0')
      text.pop_back();
  }
  return text;
}

} // namespace orb
