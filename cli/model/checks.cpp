#include "cli/model/checks.h"

#include "base/text/suggest.h"
#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

namespace orb::cli {

std::string meant_instead(const std::string& word, const std::vector<std::string>& names) {
  const auto hint = did_you_mean(word, names, {});
  return hint.empty() ? hint : "; " + hint;
}

Check one_of(std::vector<std::string> words) {
  auto list = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto known = std::make_shared<const std::vector<std::string>>(std::move(words));
  auto problem = [known](const std::string& value) -> std::string {
    if (std::find(known->begin(), known->end(), value) != known->end())
      return {};
    return fmt::format("`{}` is not one of {}{}", value, fmt::join(*known, ", "),
                       meant_instead(value, *known));
  };
  return {std::move(problem), std::move(list)};
}

Check whole_number(std::uint64_t least, std::uint64_t greatest) {
  auto problem = [=](const std::string& value) -> std::string {
    const auto number = value.starts_with("0x")
                            ? parse_number<std::uint64_t>(std::string_view(value).substr(2), 16)
                            : parse_number<std::uint64_t>(value);
    return number && *number >= least && *number <= greatest
               ? std::string()
               : fmt::format("takes {} to {}, found `{}`", least, greatest, value);
  };
  const bool bounded = greatest < std::numeric_limits<std::uint64_t>::max();
  return {std::move(problem), bounded ? fmt::format("{} to {}", least, greatest) : std::string()};
}

Check number_between(double least, double greatest) {
  auto problem = [=](const std::string& value) -> std::string {
    const auto number = parse_real(value);
    return number && *number >= least && *number <= greatest
               ? std::string()
               : fmt::format("takes {} to {}, found `{}`", least, greatest, value);
  };
  return {std::move(problem), fmt::format("{} to {}", least, greatest)};
}

} // namespace orb::cli
