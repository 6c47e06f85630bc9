#pragma once

namespace orb::cli {

/// What the shell learns from orb. Scripts depend on the numbers; they never change meaning.
enum class ExitCode : int {
  Done = 0,         ///< done; no finding of error level
  BadInput = 1,     ///< the input has errors, or the program that was run ended in a fault
  Usage = 2,        ///< wrong command line or configuration
  File = 3,         ///< an input cannot be read, or an output cannot be written
  NoBall = 4,       ///< cannot open or connect, or no answer to the first ping
  Refused = 5,      ///< the ball answered with a response code other than 0
  LinkLost = 6,     ///< link lost or timed out; the message says what is on the ball
  Unknown = 7,      ///< outcome unknown: never reported as success
  Bug = 70,         ///< a bug in orb
  Interrupted = 130 ///< Ctrl-C
};

} // namespace orb::cli
