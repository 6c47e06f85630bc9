#pragma once

#include "base/exit_code.h"
#include "base/time.h"
#include "spec/robots.h"
#include "vm/body/elsewhere.h"
#include "vm/observer.h"
#include "vm/stimulus.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

// A run on a robot, written down: `orb run --port … --record`, `orb run --replay`.

namespace orb::run {

/// Something that happened between a program and its robot, counted from the start of the program.
struct DriveLine {
  struct Number {
    std::int32_t value = 0;
  };
  /// What the robot was told, in words: `roll 90 60 1`.
  struct Told {
    std::string words;
  };
  /// The program was over; what comes after it is how the robot came to rest.
  struct Over {};
  Duration at{};
  std::variant<vm::Sample, vm::event::Collision, vm::stimulus::Battery, Number, Told, Over> what;
};

struct DriveRecording {
  spec::Robot robot = spec::Robot::Sphero;
  vm::Sample first; ///< what it said before the start
  std::vector<DriveLine> lines;
  bool stopped = false;           ///< it acknowledged the stop at the end
  std::optional<Failure> failure; ///< why the run could not go on
};

/// Text, a line an event; numbers are written so that they are read as the same.
std::string to_text(const DriveRecording& recording);

/// The error says which line is wrong.
tl::expected<DriveRecording, std::string> parse_drive_recording(std::string_view text);

/// Hands on what a robot is told, and says it in words.
class Witness final : public vm::Elsewhere {
public:
  /// `robot` may be null: then nobody drives.
  Witness(vm::Elsewhere* robot, std::function<void(std::string)> hear)
      : robot_(robot), hear_(std::move(hear)) {}
  void obey(const vm::Motion& motion) override;
  void show(vm::Color color) override;
  void show_back(int level) override;

private:
  vm::Elsewhere* robot_;
  std::function<void(std::string)> hear_;
};

} // namespace orb::run
