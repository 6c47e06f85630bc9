#pragma once

#include "base/exit_code.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/remote_body.h"
#include "vm/common/observer.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

// Recordings of runs on a robot: `orb run --port … --record`, `orb run --replay`.

namespace orb::run {

/// An event between a program and its robot. Times count from the start of the program.
struct DriveLine {
  struct Number {
    std::int32_t value = 0;
  };
  /// A command to the robot, in words: `roll 90 60 1`.
  struct SentCommand {
    std::string words;
  };
  /// The program ended; later lines show how the robot came to rest.
  struct Over {};
  Duration at{};
  std::variant<vm::Sample, vm::event::Collision, vm::stimulus::Battery, Number, SentCommand, Over>
      what;
};

struct DriveRecording {
  spec::Robot robot = spec::Robot::Sphero;
  vm::Sample first; ///< its sample before the start
  std::vector<DriveLine> lines;
  bool stopped = false;           ///< it acknowledged the final stop
  std::optional<Failure> failure; ///< why the run could not continue
};

/// Writes text, one event per line. Numbers survive a round trip unchanged.
std::string to_text(const DriveRecording& recording);

/// The error names the line.
tl::expected<DriveRecording, std::string> parse_drive_recording(std::string_view text);

/// Forwards commands to a robot and reports them in words.
class Witness final : public vm::RemoteBody {
public:
  /// `robot` may be null: commands are then only reported.
  Witness(vm::RemoteBody* robot, std::function<void(std::string)> hear)
      : robot_(robot), hear_(std::move(hear)) {}
  void obey(const vm::Motion& motion) override;
  void show(vm::Color color) override;
  void show_back(int level) override;

private:
  vm::RemoteBody* robot_;
  std::function<void(std::string)> hear_;
};

} // namespace orb::run
