#pragma once

#include "cli/robot/link.h"
#include "run/line_map.h"
#include "run/run.h"

namespace orb::cli {

/// What monitoring saw of a running program.
struct Watched {
  bool faulted = false;
  bool lost = false; ///< the link was lost
};

/// Prints a fault to stderr: its place, the value that caused it, a line to write instead.
void print_fault(const Context& context, const run::ProgramError& fault);

/// Says that the ball keeps running without the link, and how to reach it: the end of a message.
std::string robot_goes_on(const Link& link);

/// Where to look up the faults of a program on a ball.
struct Lookup {
  run::LineMap lines;
  const run::Input* input = nullptr; ///< the source; null if there is none
};

/// Sees the monitored messages in addition to the printed output.
class Spectator {
public:
  virtual ~Spectator() = default;
  /// Returns true to keep the message from being printed.
  virtual bool takes(const protocol::Async& message) = 0;
  /// Called after a pause or many messages; returns false to end monitoring.
  virtual bool goes_on() = 0;
};

/// Prints what comes from the ball until Ctrl-C, or until the built-in ball is at rest. Prints go
/// to stdout unchanged; markers, collisions and sensor values one per line; errors go to stderr.
/// With the format `json`, everything is a line of JSON on stdout (docs/reference/json.md).
/// `spectator` may be null.
Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const Lookup& lookup, std::string_view format = "text",
                Spectator* spectator = nullptr);

/// How a program started.
struct Began {
  ExitCode exit = ExitCode::Done;
  std::string words; ///< `started`, or why it has ended
};

/// Waits at most a second (Budgets::start_sign) for the first print or error of a program that was
/// just started. Prints a fault as monitor() does, and stops the wheels.
Began watch_start(const Context& context, const Link& link, uploader::Session& session,
                  const Lookup& lookup);

} // namespace orb::cli
