#pragma once

#include "playground/engine/request.h"
#include "run/tether/tether.h"
#include "spec/edu.h"

#include <deque>
#include <string>
#include <utility>

namespace orb::playground {

/// Executes the calls of an Edu program on a robot. They come from a sandbox: no call may do harm,
/// whatever it holds.
class EduHands {
public:
  EduHands(run::Tether& tether, spec::Robot robot) : tether_(tether), robot_(spec::info(robot)) {}

  /// One call: its name, then its values.
  void perform(const ordered_json& deed);
  /// Passes pending commands on, as fast as the robot takes them.
  void push();
  bool is_idle() const { return waiting_.empty() && tether_.is_idle(); }

  /// The robot's heading that is 0 for the program.
  int aim() const { return aim_; }
  /// Makes the robot's present direction `heading` for the program.
  void aim_at(int facing_deg, int heading) { aim_ = facing_deg - heading; }
  void faces(int facing_deg) { facing_ = facing_deg; }

private:
  void drive(const ordered_json& deed);
  void motors(const ordered_json& deed);
  void light(spec::EduCall call, const ordered_json& value);
  void draw(spec::V2Command command, const ordered_json& deed);
  void animation(const ordered_json& picture);
  void send(spec::V2Command command, Bytes data, std::string key = {});
  void send(run::Request request, std::string key);
  bool knows(spec::V2Command command) const { return spec::knows(robot_, spec::info(command)); }

  run::Tether& tether_;
  const spec::RobotInfo& robot_;
  /// Pending commands; only the latest of each key is sent.
  std::deque<std::pair<std::string, run::Request>> waiting_;
  int aim_ = 0;
  int facing_ = 0;
  int pictures_ = 0;   ///< stored frames
  int animations_ = 0; ///< of these frames
};

} // namespace orb::playground
