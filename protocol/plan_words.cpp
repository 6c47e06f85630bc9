#include "protocol/plan_words.h"

#include "base/duration.h"
#include "base/text/text.h"

#include <fmt/format.h>

namespace orb::protocol {

tl::unexpected<std::string> wrong_word(std::string_view item, std::string_view what) {
  return tl::unexpected(fmt::format("`{}` in the fault plan: {}", item, what));
}

std::optional<double> read_rate(std::string_view text) {
  constexpr double percents = 100; // in a whole
  if (!text.ends_with("%"))
    return std::nullopt;
  text.remove_suffix(1);
  const auto percent = parse_number<double>(text);
  if (!percent || *percent < 0 || *percent > percents)
    return std::nullopt;
  return *percent / percents;
}

std::optional<Duration> read_delay(std::string_view text) {
  const auto time = parse_duration(text, 1ms);
  return time && *time <= 1h ? time : std::nullopt;
}

std::pair<std::string_view, std::string_view> split_item(std::string_view item) {
  const auto at = item.find_first_of("=@");
  if (at == item.npos)
    return {item, {}};
  return {item.substr(0, at + 1), item.substr(at + 1)};
}

std::pair<std::string_view, std::string_view> split_range(std::string_view text) {
  const auto dots = text.find("..");
  return {text.substr(0, dots), dots == text.npos ? text : text.substr(dots + 2)};
}

} // namespace orb::protocol
