#pragma once

#include "base/exit_code.h"
#include "base/style.h"
#include "cli/context/config.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace orb::cli {

/// What every command shares: the options that stand before or after any command, and the code it
/// ends with. One per process, made in main().
struct Context {
  bool quiet = false;
  int verbosity = 0; ///< 1 for -v, 2 for -vv (wire trace)
  std::string color = "auto";
  std::string ui_language; ///< of findings; empty for that of the environment
  Config config;
  ExitCode exit = ExitCode::Done;

  /// Whether text on stdout, or on stderr, is coloured: the flag, then CLICOLOR_FORCE, NO_COLOR,
  /// TERM=dumb, then whether it is a terminal.
  Style out_style() const;
  Style err_style() const;
};

/// Takes what this thread prints in place of stdout and stderr, as long as it lives: for commands
/// that speak to several robots at once.
class OutputTap {
public:
  enum class Stream : std::uint8_t { Out, Err };
  using Take = std::function<void(Stream, std::string_view)>;
  explicit OutputTap(Take take);
  ~OutputTap();
  OutputTap(const OutputTap&) = delete;
  OutputTap& operator=(const OutputTap&) = delete;

  /// What this thread prints goes to the streams all the same, as long as it lives.
  class Closed {
  public:
    Closed();
    ~Closed();
    Closed(const Closed&) = delete;
    Closed& operator=(const Closed&) = delete;

  private:
    Take take_;
  };
};

/// Writes to stdout. Where that fails the command ends (OutputError): silently when the reader went
/// away (a closed pipe).
void print_out(std::string_view text);

/// Writes to stderr.
void print_err(std::string_view text);

/// Prints a note to stderr, a line, unless -q was given.
void print_note(const Context& context, std::string_view message);

/// Prints `orb: error: MESSAGE` to stderr.
void print_error(const Context& context, std::string_view message);

/// Prints how something ended: a note where that is Done, else an error, which -q does not silence.
void print_ended(const Context& context, ExitCode how, std::string_view message);

/// Prints why the command cannot do what it should, and leaves the code to end with.
void fail(Context& context, const Failure& failure);

} // namespace orb::cli
