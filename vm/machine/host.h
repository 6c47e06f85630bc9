#pragma once

#include "base/time.h"
#include "spec/basic.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace orb::vm {

/// All that a running program can do to the ball and ask of it. Ball implements it; tests have an
/// implementation of their own. `now` is the end of the line that asks.
class Host {
public:
  virtual ~Host() = default;

  /// The value of a system variable that is not a timer. Reading some of them clears them.
  virtual std::int32_t read(spec::Variable variable, Instant now) = 0;

  /// Assigns a system variable that is not a timer.
  virtual std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                                Instant now) = 0;

  /// Does what a statement asks of the ball; its arguments are within their documented ranges.
  virtual std::optional<spec::BasicError>
  perform(spec::Statement statement, std::span<const std::int32_t> arguments, Instant now) = 0;

  /// Sends a text. Nothing is sent when the queue is too full: the program asks again at the
  /// instant that is returned.
  virtual std::optional<Instant> print(std::string_view text, Instant now) = 0;

  /// A line ended; called only for a machine that traces lines.
  virtual void line_ended(int line, Instant now) = 0;
};

} // namespace orb::vm
