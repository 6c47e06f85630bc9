#pragma once

#include "cli/robot/link.h"
#include "run/line_map.h"
#include "run/run.h"

namespace orb::cli {

/// What was seen of a program that runs.
struct Watched {
  bool faulted = false;
  bool lost = false; ///< the link ended by itself
};

/// Prints a fault of the robot to stderr: where it is, which value it was, the line to write.
void print_fault(const Context& context, const run::ProgramError& fault);

/// That what runs on a ball goes on without the link, and how to reach it: for the end of a
/// message.
std::string robot_goes_on(const Link& link);

/// Where the faults of a program on a ball are looked up.
struct Lookup {
  run::LineMap lines;
  const run::Input* input = nullptr; ///< the source, where there is one to look into
};

/// Sees what is monitored, besides what is printed.
class Spectator {
public:
  virtual ~Spectator() = default;
  /// Whether the message is not to be printed.
  virtual bool takes(const protocol::Async& message) = 0;
  /// Nothing has come for a while, or much; false: it has seen enough.
  virtual bool goes_on() = 0;
};

/// Prints what comes from the ball until Ctrl-C, or until the built-in ball is at rest: prints to
/// stdout as they are, markers, collisions and sensor values a line each; errors to stderr. With
/// the format `json` everything is a line of JSON on stdout (docs/json.md). `spectator` may be
/// null.
Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const Lookup& lookup, std::string_view format = "text",
                Spectator* spectator = nullptr);

/// How a program began.
struct Began {
  ExitCode exit = ExitCode::Done;
  std::string words; ///< `started`, or why it does not run any more
};

/// Waits for the first print or error of a program that was just started, at most a second
/// (Budgets::start_sign). A fault is printed as monitor() does, and the wheels are stopped.
Began watch_start(const Context& context, const Link& link, uploader::Session& session,
                  const Lookup& lookup);

} // namespace orb::cli
