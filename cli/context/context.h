#pragma once

#include "base/exit_code.h"
#include "base/style.h"
#include "cli/context/config.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace orb::cli {

/// State that all commands share: the global options and the exit code. One per process, made in
/// main().
struct Context {
  bool quiet = false;
  int verbosity = 0; ///< 1 for -v, 2 for -vv (wire trace)
  std::string color = "auto";
  std::string ui_language; ///< of findings; empty: from the environment
  Config config;
  ExitCode exit = ExitCode::Done;

  /// The style for stdout and stderr. In order of precedence: the flag, CLICOLOR_FORCE, NO_COLOR,
  /// TERM=dumb, and whether the stream is a terminal.
  Style out_style() const;
  Style err_style() const;
};

/// Captures what this thread prints to stdout and stderr during its lifetime, for commands that
/// work with several robots at once.
class OutputTap {
public:
  enum class Stream : std::uint8_t { Out, Err };
  using Take = std::function<void(Stream, std::string_view)>;
  explicit OutputTap(Take take);
  ~OutputTap();
  OutputTap(const OutputTap&) = delete;
  OutputTap& operator=(const OutputTap&) = delete;

  /// Lets this thread print to the real streams during its lifetime.
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

/// Writes to stdout. A failure throws OutputError, which ends the command; silently if the reader
/// has closed the pipe.
void print_out(std::string_view text);

/// Writes to stderr.
void print_err(std::string_view text);

/// Prints a one-line note to stderr, unless -q was given.
void print_note(const Context& context, std::string_view message);

/// Prints `orb: warning: MESSAGE` to stderr.
void print_warning(const Context& context, std::string_view message);

/// Prints `orb: error: MESSAGE` to stderr.
void print_error(const Context& context, std::string_view message);

/// Prints how something ended: a note for Done, else an error, which -q does not suppress.
void print_ended(const Context& context, ExitCode how, std::string_view message);

/// Prints the failure and sets its exit code.
void fail(Context& context, const Failure& failure);

} // namespace orb::cli
