#pragma once

#include "base/time.h"
#include "spec/api.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

class Ball;

/// The self level routine: waits until pitch and roll have stayed below a limit for a while.
/// Source: API §Self Level.
class SelfLevel {
public:
  /// The operands of the command; 0 stands for the default.
  struct Request {
    std::uint32_t options = 0;
    std::uint8_t angle_limit_deg = 0;
    std::uint8_t timeout_s = 0;
    std::uint8_t true_time_10ms = 0;
  };

  void start(const Request& request, Ball& ball);
  bool running() const { return next_ != never; }
  /// Stops it at once; the result is `aborted`.
  void abort(Ball& ball);
  /// Forgets it without a word.
  void cancel() { next_ = never; }

  Instant next_event() const { return next_; }
  void run(Instant now, Ball& ball);

private:
  void finish(std::uint8_t result, Ball& ball);

  Request request_;
  double first_heading_deg_ = 0;
  Instant next_ = never;
  Instant deadline_{};
  std::optional<Instant> level_since_;
};

} // namespace orb::vm
