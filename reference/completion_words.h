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

/// What could stand at the end of a command line.
struct Completions {
  std::vector<Candidate> candidates; ///< all begin with the word that is being typed
  bool files = false;                ///< names of files fit too
};

/// What fits in the place of the last of `words`. `words` is what was typed without the program's
/// name; its last word is the one being typed and may be empty. `ports` are the balls that this
/// computer knows by name or by device.
Completions complete(const CommandLine& line, std::span<const Candidate> ports,
                     std::span<const std::string> words);

/// The answer to the scripts: a candidate a line, then a tab and its summary where it has one; and
/// a line `:files` where names of files fit.
std::string print(const Completions& completions);

} // namespace orb::reference
