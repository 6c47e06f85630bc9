#include "structured/text/numeral.h"

#include "base/text/text.h"

#include <algorithm>
#include <charconv>

namespace orb::structured {

Numeral read_numeral(std::string_view text) {
  constexpr std::int64_t most = 2147483648; // with a minus sign before it the least number
  Numeral numeral;
  std::int64_t whole = 0;
  if (text.size() > 2 && text[0] == '0' && to_lower(text[1]) == 'x') {
    const auto read = std::from_chars(text.data() + 2, text.data() + text.size(), whole, 16);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || whole >= most)
      return {Numeral::State::Bad, false, 0};
    numeral.value = static_cast<std::int32_t>(whole);
    return numeral;
  }
  auto read = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (read.ec != std::errc{} || whole > most)
    return {Numeral::State::Bad, false, 0};
  auto rest = text.substr(static_cast<std::size_t>(read.ptr - text.data()));
  std::string_view digits;
  if (!rest.empty() && rest.front() == '.') {
    const auto end = std::find_if_not(rest.begin() + 1, rest.end(), is_digit);
    digits = rest.substr(1, static_cast<std::size_t>(end - rest.begin()) - 1);
    rest.remove_prefix(digits.size() + 1);
    if (digits.empty() || digits.size() > 9 || rest.empty())
      return {Numeral::State::Bad, false, 0};
  }
  if (rest.empty()) {
    numeral.value = static_cast<std::int32_t>(static_cast<std::uint32_t>(whole));
    return numeral;
  }
  const std::int64_t unit = equal_words(rest, "ms")    ? 1
                            : equal_words(rest, "s")   ? 1000
                            : equal_words(rest, "min") ? 60000
                                                       : 0;
  if (unit == 0)
    return {Numeral::State::Bad, false, 0};
  std::int64_t scale = 1;
  std::int64_t fraction = 0;
  for (const char c : digits) {
    fraction = fraction * 10 + (c - '0');
    scale *= 10;
  }
  if (fraction * unit % scale != 0)
    return {Numeral::State::Fraction, true, 0};
  const auto value = whole * unit + fraction * unit / scale;
  if (value >= most)
    return {Numeral::State::Bad, true, 0};
  return {Numeral::State::Good, true, static_cast<std::int32_t>(value)};
}

} // namespace orb::structured
