#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace orb::cli {

/// A page of the manual as a file: `orb-check.1` and its mdoc source.
struct ManualPage {
  std::string file;
  std::string text;
};

/// The whole manual, printed from the option model and the tables: `orb`, a page for each command,
/// `orbbasic` and `orb-macro`.
std::vector<ManualPage> manual(const CLI::App& app);

} // namespace orb::cli
