#pragma once

#include "cli/context/context.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace orb::cli {

/// The state of a run since the last query.
enum class RunEnd { NotYet, Finished, ReaderGone };

/// The loop of watch(), on top of each system's own parts. `Runs` starts a run with start(), ending
/// the previous one, reports its end(), and waits a tenth of a second for Ctrl-C in interrupted().
/// `stamp` returns a value that changes when a file is written, replaced or removed. Polling works
/// on every file system and for every way in which editors save; notifications do not.
template <class Runs, class StampOf>
void watch_with(Runs&& runs, StampOf* stamp, Context& context,
                const std::function<std::vector<std::string>()>& list,
                const std::function<void()>& ended) {
  const auto look = [&](const std::vector<std::string>& files) {
    std::vector<decltype(stamp({}))> seen;
    std::transform(files.begin(), files.end(), std::back_inserter(seen), stamp);
    return seen;
  };
  auto files = list();
  auto seen = look(files);
  runs.start();
  while (!runs.interrupted()) {
    const auto end = runs.end();
    if (end == RunEnd::ReaderGone)
      return;
    if (end == RunEnd::Finished) {
      ended();
      print_note(context, "waiting for a change; Ctrl-C to stop");
    }
    const auto now = look(files);
    if (now == seen)
      continue;
    const auto changed = std::mismatch(now.begin(), now.end(), seen.begin()).first - now.begin();
    print_note(context, fmt::format("--- {} changed", files[static_cast<std::size_t>(changed)]));
    files = list();
    seen = look(files);
    runs.start();
  }
}

} // namespace orb::cli
