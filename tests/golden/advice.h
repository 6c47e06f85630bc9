#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// What commands suggest, tried where they suggested it: nobody can follow advice that is refused.
namespace advice {

struct Ran {
  std::string out;
  std::string err;
  int exit = 0;
};

/// Runs a command in a folder.
using Run = std::function<Ran(const std::string& command, const std::filesystem::path& folder)>;

/// What is wrong with what a command suggested, a sentence each. The command ran in `work`, which
/// stays as it is.
///
/// - `orb COMMAND --option`: there are such a command and such an option.
/// - ``add `--option value` ``: the command takes it, and does not ask for it again.
/// - ``write `LINE` ``: in the place of the one that was found, or of the piece that is marked, it
///   is not found again, and nothing else is wrong with it.
std::vector<std::string> problems(const std::string& command, const Ran& ran,
                                  const std::filesystem::path& work, const Run& run);

/// The same for a page, of which no command is the author.
std::vector<std::string> problems_of_page(const std::string& text, const Run& run);

/// The same for all that `--help` prints: what it quotes, and its examples.
std::vector<std::string> problems_of_help(const Run& run);

/// How many suggestions have been tried.
std::size_t tried();

} // namespace advice
