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

/// How balls are served.
struct ServeOptions {
  struct Tcp {
    std::string host;
    std::uint16_t port = 0; ///< 0 picks a free port; several balls count up
  };
  std::optional<Tcp> tcp;
  bool pty = false;
  std::string pty_link; ///< symlink to the slave; empty: none
  /// Simulated Bluetooth LE with these faults.
  std::optional<protocol::BleFaultPlan> bluez;
  int count = 1;
  double speed = 1;                        ///< seconds of the ball per second
  spec::Robot robot = spec::Robot::Sphero; ///< determines the packets
  vm::BallOptions ball;
  std::vector<vm::TimedStimulus> stimulus;
  std::optional<protocol::FaultPlan> fault;
  std::string state_file; ///< empty: none
  std::string log_file;   ///< a recording; empty: none
  /// Source of control lines, with the contract of read(2) (serve/control.h); empty: none.
  std::function<ssize_t(std::span<char>)> control;
  /// Returns the observer of a ball by index, which must outlive it; empty: none.
  std::function<Spectator*(int)> watch;
  /// Returns the witness of the bytes, likewise.
  std::function<Witness*(int)> hear;
  std::function<void(std::string_view)> announce = [](std::string_view) {
  }; ///< receives a line per link, and each changed address
  std::function<void(std::string_view)> answer = [](std::string_view) {
  }; ///< receives answers to control lines
  std::function<void(std::string_view)> note = [](std::string_view) {
  }; ///< receives news about a ball
  std::function<void(std::string_view)> warn = [](std::string_view) {
  }; ///< receives warnings and failures
};

/// Serves balls until SIGINT or SIGTERM. Fails if a link, the state or the log cannot be opened,
/// the state cannot be saved, or a handler throws; the state is saved in that case, too.
tl::expected<void, Failure> serve(const ServeOptions& options);

} // namespace orb::serve
