#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// A page of the documentation as something to be run: what its fences hold.
///
///   ```sh            each line is a command, which must succeed; what it prints is not shown
///   ```console       `$ COMMAND`, then what it prints, which is compared
///   ```basic         a listing (also orb, macro, stimulus, test): `orb check` finds no error in it
///   ```text          nothing to run (also json, toml, yaml, cpp, cmake, python)
///
/// A line right above a fence, or on its own, says what a reader need not see:
///
///   <!-- file: NAME -->         the fence below is a file of that name for the commands of the
///   page
///   <!-- not run: REASON -->    the fence below cannot be run: it needs a ball, never ends,
///   installs
///   <!-- run: COMMAND -->       prepares what the next commands take for granted
///
/// The commands of a page run in one bash, in a fresh folder; `$ROOT` is the checkout.
namespace docs {

struct Command {
  std::size_t line = 0; ///< of the page, from 1
  std::string text;
  bool shown = false; ///< what it prints stands on the page
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
  std::vector<Command> commands; ///< in the order of the page, the checks of listings among them
  std::vector<Problem> problems; ///< a fence that does not say what it holds
};

Page read(std::string_view text);

/// The page with the outputs of its `console` fences replaced by those of `ran`, whose commands are
/// the page's own.
std::string with_outputs(std::string_view text, const std::vector<Command>& ran);

/// Runs the page's commands in `folder`, where its files lie already; what they print passes
/// through files in `logs`.
std::vector<Command> run(const Page& page, const std::string& folder, const std::string& logs);

} // namespace docs
