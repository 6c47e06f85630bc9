#pragma once

#include "base/time.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

/// How plans of faults are written: words with commas between them.
namespace orb::protocol {

/// Why an item is no word of a plan.
tl::unexpected<std::string> wrong_word(std::string_view item, std::string_view what);

/// The share that `1%` or `0.1%` is.
std::optional<double> read_rate(std::string_view text);

/// `300ms`, `0.2s`, or a bare number of milliseconds; at most an hour.
std::optional<Duration> read_delay(std::string_view text);

/// The name of an item, `=` or `@` included, and what follows it.
std::pair<std::string_view, std::string_view> split_item(std::string_view item);

/// The two ends of `1..20`, or the same value twice where it is one alone.
std::pair<std::string_view, std::string_view> split_range(std::string_view text);

/// Lets `read` take in each word of `text`, up to the first that is wrong.
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
