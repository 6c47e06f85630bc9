#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// A page of the documentation as commands, files and listings.
///
///   ```sh            each line is a command that must succeed; its output is ignored
///   ```console       `$ COMMAND`, then its output, which is compared
///   ```basic         a listing (also orb, macro, stimulus, test): `orb check` finds no error in it
///   ```text          not run (also json, toml, yaml, cpp, cmake, python)
///
/// A comment above a fence, or on its own, holds what a reader need not see:
///
///   <!-- file: NAME -->         the fence below is a file of that name for the page's commands
///   <!-- not run: REASON -->    the fence below cannot be run: it needs a ball, never ends …
///   <!-- run: COMMAND -->       prepares what the next commands rely on
///
/// The commands of a page run in one bash, in a fresh folder; `$ROOT` is the checkout.
namespace docs {

struct Command {
  std::size_t line = 0; ///< in the page, from 1
  std::string text;
  bool shown = false; ///< the page shows its output
  std::string output; ///< as shown, standard error included
  int exit = 0;
};

struct File {
  std::string name;
  std::string text;
};

struct Problem {
  std::size_t line = 0;
  std::string text;
};

struct Page {
  std::vector<File> files;
  std::vector<Command> commands; ///< in the order of the page, including the checks of listings
  std::vector<Problem> problems; ///< a fence without a language
};

Page read(std::string_view text);

/// Returns the page with the outputs of its `console` fences replaced by those of `ran`, its own
/// commands.
std::string with_outputs(std::string_view text, const std::vector<Command>& ran);

/// Runs the page's commands in `folder`, which already holds its files. Their output goes through
/// files in `logs`.
std::vector<Command> run(const Page& page, const std::string& folder, const std::string& logs);

} // namespace docs
