#pragma once

namespace orb::cli {

/// Stdout takes no more. Thrown by print_out() to end whatever the command was doing; main() knows
/// what to say.
struct OutputError {
  int error; ///< as errno; EPIPE where the reader has left
};

} // namespace orb::cli
