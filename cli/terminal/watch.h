#pragma once

#include "cli/context/context.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// The files, and those that the structured programs among them include or use.
std::vector<std::string> files_of(const std::vector<std::string>& files, std::string_view lang);

/// Runs `once` now and whenever one of `files()` changes, until Ctrl-C or SIGTERM; then the exit
/// code is Done. `files` is called again each time. `once` runs in a child process: a change ends
/// an unfinished run, and its exit code is lost. Output is as without watching; notes go to stderr.
/// Calls `ended` in this process after each finished run. `words` are options that this process
/// generated; the child gets them too if it starts from its command line.
void watch(
    Context& context, const std::function<std::vector<std::string>()>& files,
    const std::function<void()>& once, const std::function<void()>& ended = [] {},
    const std::vector<std::string>& words = {});

} // namespace orb::cli
