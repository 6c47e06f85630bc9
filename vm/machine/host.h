#pragma once

#include "base/time.h"
#include "spec/basic.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace orb::vm {

/// The program's view of the ball: everything a running program may read or do. Ball implements it,
/// and tests substitute their own. `now` is the end of the calling line.
class Host {
public:
  virtual ~Host() = default;

  /// Returns a system variable other than a timer. Reading clears some of them.
  virtual std::int32_t read(spec::Variable variable, Instant now) = 0;

  /// Assigns a system variable other than a timer.
  virtual std::optional<spec::BasicError> write(spec::Variable variable, std::int32_t value,
                                                Instant now) = 0;

  /// Executes a statement. Its arguments are within their documented ranges.
  virtual std::optional<spec::BasicError>
  perform(spec::Statement statement, std::span<const std::int32_t> arguments, Instant now) = 0;

  /// Sends text. If the queue is too full it sends nothing and returns when to try again.
  virtual std::optional<Instant> print(std::string_view text, Instant now) = 0;

  /// Called after each line, if the machine traces lines.
  virtual void line_ended(int line, Instant now) = 0;
};

} // namespace orb::vm
