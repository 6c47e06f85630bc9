#pragma once

namespace orb::cli {

/// Thrown by print_out() if stdout takes no more; ends the current command. main() reports it.
struct OutputError {
  int error; ///< errno; EPIPE if the reader has left
};

} // namespace orb::cli
