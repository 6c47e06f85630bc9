#pragma once

#include "base/time.h"
#include "spec/api.h"
#include "vm/body/body.h"

#include <cstdint>
#include <optional>

namespace orb::vm {

/// The self level routine: waits until pitch and roll stay below a limit for a while. The caller
/// stops the ball first and carries out the options afterwards. Source: API §Self Level.
class SelfLevel {
public:
  /// The command's operands; 0 means the default.
  struct Request {
    std::uint32_t options = 0;
    std::uint8_t angle_limit_deg = 0;
    std::uint8_t timeout_s = 0;
    std::uint8_t true_time_10ms = 0;
  };

  void start(const Request& request, const Body& body, Instant now);
  bool running() const { return next_ != never; }
  void stop() { next_ = never; }
  /// Returns true if the request sets this option of spec::self_level_options.
  bool wants(std::uint32_t option) const { return (request_.options & option) != 0; }
  double first_heading_deg() const { return first_heading_deg_; }

  Instant next_event() const { return next_; }
  /// Returns a value of spec::self_level_result once the routine has finished.
  std::optional<std::uint8_t> run(Instant now, const Body& body);

private:
  Request request_;
  double first_heading_deg_ = 0;
  Instant next_ = never;
  Instant deadline_{};
  std::optional<Instant> level_since_;
};

} // namespace orb::vm
