#pragma once

#include "cli/config.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace orb::cli {

struct Candidate {
  std::string word;
  std::string summary; ///< may be empty
};

/// What could stand at the end of a command line.
struct Completions {
  std::vector<Candidate> candidates; ///< all begin with the word that is being typed
  bool files = false;                ///< names of files fit too
};

/// What fits in the place of the last of `words`, read from the option model of `app`. `words` is
/// the command line without the program's name; its last word is the one being typed and may be
/// empty. Ports and named balls come from `config` and from the devices of this computer.
Completions complete(const CLI::App& app, const Config& config, std::span<const std::string> words);

/// The first word of a command line by which the completion scripts ask: `orb __complete -- WORDS`.
/// It is no command of the option model, because the words behind it are data, not options.
inline constexpr std::string_view completion_request = "__complete";

/// The answer to the scripts: a candidate a line, then a tab and its summary where it has one; and
/// a line `:files` where names of files fit.
std::string print(const Completions& completions);

} // namespace orb::cli
