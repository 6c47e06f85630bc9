#pragma once

#include "reference/command_data.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::reference {

struct Candidate {
  std::string word;
  std::string summary; ///< may be empty
};

/// Completions at the end of a command line.
struct Completions {
  std::vector<Candidate> candidates; ///< all begin with the word being typed
  bool files = false;                ///< file names fit as well
};

/// Completes the last of `words`: the typed words without the program's name; the last one may be
/// empty. `ports` are the balls known by name or by device.
Completions complete(const CommandLine& line, std::span<const Candidate> ports,
                     std::span<const std::string> words);

/// The answer for the completion scripts: one candidate per line, followed by a tab and its summary
/// if it has one; and a line `:files` if file names fit.
std::string print(const Completions& completions);

} // namespace orb::reference
