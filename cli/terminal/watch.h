#pragma once

#include "cli/context/context.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// The files, and those that the structured programs among them include or use.
std::vector<std::string> files_of(const std::vector<std::string>& files, std::string_view lang);

/// Runs `once` now and again whenever one of `files()` changes, which is asked again each time,
/// until Ctrl-C or SIGTERM; then the exit code is Done. `once` runs in a process of its own: a
/// change ends a run that still goes on, and the code that it leaves in the context is lost with
/// it. What it prints is as without watching; notes go to stderr. `ended` is called here when such
/// a run came to its end. `words` are options that this process has made up: where the process of a
/// run begins with its command line, it gets them, too.
void watch(
    Context& context, const std::function<std::vector<std::string>()>& files,
    const std::function<void()>& once, const std::function<void()>& ended = [] {},
    const std::vector<std::string>& words = {});

} // namespace orb::cli
