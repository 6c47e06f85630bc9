#pragma once

#include <array>
#include <string>
#include <string_view>

namespace orb {

/// The exit codes of orb. Scripts depend on them: a number never changes its meaning.
enum class ExitCode : int {
  Done = 0,
  BadInput = 1,
  Usage = 2,
  File = 3,
  NoBall = 4,
  Refused = 5,
  LinkLost = 6,
  Unknown = 7,
  Bug = 70,
  Interrupted = 130, ///< 128 + SIGINT, the shell convention
};

struct ExitCodeInfo {
  ExitCode code;
  std::string_view meaning;
};

/// The meaning of each exit code, for the manual and the help.
inline constexpr auto exit_codes = std::to_array<ExitCodeInfo>({
    {ExitCode::Done, "done; no findings at error level"},
    {ExitCode::BadInput,
     "the input has errors, or the program or macro that was run ended in a fault"},
    {ExitCode::Usage, "wrong command line or configuration"},
    {ExitCode::File, "an input cannot be read, or an output cannot be written"},
    {ExitCode::NoBall,
     "no such ball: it cannot be opened or connected to, or does not answer the first ping"},
    {ExitCode::Refused, "the ball refused a command; the message names the command and the remedy. "
                        "With several robots: one failed"},
    {ExitCode::LinkLost,
     "the link was lost or timed out; the message says what is on the ball now"},
    {ExitCode::Unknown,
     "the outcome is unknown, for example because the answer to a commit was lost"},
    {ExitCode::Bug, "a bug in orb"},
    {ExitCode::Interrupted, "an upload or a command to a ball was ended by Ctrl-C"},
});

/// A failed operation: the sentence to print and the exit code.
struct Failure {
  ExitCode code = ExitCode::BadInput;
  std::string message;
};

} // namespace orb
