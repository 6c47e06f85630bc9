#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Follows the advice that commands give, in the folder where they gave it: advice that is refused
/// is useless.
namespace advice {

struct Ran {
  std::string out;
  std::string err;
  int exit = 0;
};

/// Runs a command in a folder.
using Run = std::function<Ran(const std::string& command, const std::filesystem::path& folder)>;

/// Returns a sentence for each piece of advice that does not work. The command ran in `work`, which
/// stays unchanged.
///
/// - `orb COMMAND --option`: the command and the option must exist.
/// - ``add `--option value` ``: the command must take it, and not ask for it again.
/// - ``write `LINE` ``: in place of the line with the finding, or of the marked piece, it must have
///   neither the same finding nor another error.
std::vector<std::string> problems(const std::string& command, const Ran& ran,
                                  const std::filesystem::path& work, const Run& run);

/// The same for a page.
std::vector<std::string> problems_of_page(const std::string& text, const Run& run);

/// The same for everything `--help` prints: quoted commands and examples.
std::vector<std::string> problems_of_help(const Run& run);

/// The number of suggestions tried so far.
std::size_t tried();

} // namespace advice
