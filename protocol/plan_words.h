#pragma once

#include "base/time.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

/// The notation of fault plans: words separated by commas.
namespace orb::protocol {

/// Returns the error for an invalid item.
tl::unexpected<std::string> wrong_word(std::string_view item, std::string_view what);

/// Parses a rate such as `1%` or `0.1%`.
std::optional<double> read_rate(std::string_view text);

/// Parses `300ms`, `0.2s`, or a bare number of milliseconds; at most an hour.
std::optional<Duration> read_delay(std::string_view text);

/// Splits an item into its name, including `=` or `@`, and the rest.
std::pair<std::string_view, std::string_view> split_item(std::string_view item);

/// Splits `1..20`; a single value is returned twice.
std::pair<std::string_view, std::string_view> split_range(std::string_view text);

/// Calls `read` for each word of `text`, up to the first error.
template <class Read>
tl::expected<void, std::string> read_words(std::string_view text, const Read& read) {
  while (true) {
    const auto comma = std::min(text.find(','), text.size());
    if (tl::expected<void, std::string> done = read(text.substr(0, comma)); !done)
      return done;
    if (comma == text.size())
      return {};
    text.remove_prefix(comma + 1);
  }
}

} // namespace orb::protocol
