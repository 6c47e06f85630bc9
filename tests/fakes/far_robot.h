#pragma once

#include "compiler/load.h"
#include "protocol/link_faults.h"
#include "run/run.h"
#include "spec/robots.h"
#include "structured/text/files.h"
#include "vm/ball_transport.h"
#include "vm/common/bluetooth.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace orb::test {

/// A virtual robot behind a link with the faults of a plan, in virtual time.
class FarRobot {
public:
  FarRobot(spec::Robot which, const protocol::FaultPlan& plan, Duration round_trip,
           vm::Observer* observer = nullptr) {
    vm::BallOptions options;
    options.seed = plan.seed;
    options.loader = compiler::load;
    options.robot = which;
    options.driving = spec::driving(which);
    options.observer = observer;
    ball = std::make_unique<vm::Ball>(options);
    const auto packets = spec::info(which).packets;
    const vm::WireModel model{round_trip};
    std::unique_ptr<protocol::Transport> wire;
    if (packets == spec::Packets::V2) {
      v2_ = std::make_unique<vm::RobotV2>(*ball, which, vm::bluetooth_address(plan.seed));
      wire = std::make_unique<vm::BallTransport>(*ball, *v2_, model);
    } else
      wire = std::make_unique<vm::BallTransport>(*ball, model);
    link = std::make_unique<protocol::FaultTransport>(std::move(wire), plan, packets);
  }

  bool drives() const { return ball->body().is_driven(); }

  /// The link falls silent.
  void live_on(Duration time) {
    constexpr Duration glance = 10ms;
    for (const auto end = ball->now() + time; ball->now() < end;) {
      ball->advance_to(ball->now() + glance);
      if (v2_)
        v2_->run();
    }
  }

  std::unique_ptr<vm::Ball> ball;

private:
  std::unique_ptr<vm::RobotV2> v2_;

public:
  std::unique_ptr<protocol::Transport> link; ///< destroyed before the far end
};

/// Reads an orbBasic program as `orb run` does.
inline std::vector<run::Input> program_of(std::string_view text) {
  structured::NoFiles files;
  std::vector<run::Input> inputs;
  inputs.push_back(*run::read_input("p.bas", std::string(text), {}, {}, files));
  return inputs;
}

} // namespace orb::test
