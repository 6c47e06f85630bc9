#pragma once

#include "base/exit_code.h"
#include "protocol/ble_faults.h"
#include "protocol/link_faults.h"
#include "serve/spectator.h"
#include "spec/robots.h"
#include "vm/ball.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <tl/expected.hpp>
#include <vector>

namespace orb::serve {

/// Where and how balls are served.
struct ServeOptions {
  struct Tcp {
    std::string host;
    std::uint16_t port = 0; ///< 0 picks a free one; several balls count up
  };
  std::optional<Tcp> tcp;
  bool pty = false;
  std::string pty_link; ///< a symlink to the slave; empty for none
  /// Behind a Bluetooth LE that there is not, with these faults.
  std::optional<protocol::BleFaultPlan> bluez;
  int count = 1;
  double speed = 1;                        ///< seconds of the ball per second
  spec::Robot robot = spec::Robot::Sphero; ///< whose packets it speaks
  vm::BallOptions ball;
  std::vector<vm::TimedStimulus> stimulus;
  std::optional<protocol::FaultPlan> fault;
  std::string state_file; ///< empty for none
  std::string log_file;   ///< a recording; empty for none
  /// Where lines of control come from, as from read(2) (serve/control.h); empty for nowhere.
  std::function<ssize_t(std::span<char>)> control;
  /// Who watches the ball of that index, and outlives it; empty for nobody.
  std::function<Spectator*(int)> watch;
  std::function<void(std::string_view)> announce = [](std::string_view) {
  }; ///< hears a line per link, and where one moves
  std::function<void(std::string_view)> answer = [](std::string_view) {
  }; ///< hears what control lines are answered
  std::function<void(std::string_view)> note = [](std::string_view) {
  }; ///< hears what a ball does by itself
  std::function<void(std::string_view)> warn = [](std::string_view) {
  }; ///< hears what is unsafe or has failed
};

/// Serves balls until SIGINT or SIGTERM. Fails when a link, the state or the log cannot be opened,
/// the state cannot be kept, or a handler throws; the state has been kept then, too.
tl::expected<void, Failure> serve(const ServeOptions& options);

} // namespace orb::serve
