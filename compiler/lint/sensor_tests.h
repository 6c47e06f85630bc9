#pragma once

#include "base/message.h"
#include "base/rules.h"
#include "spec/basic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::compiler {

constexpr bool is_timer(spec::Variable variable) {
  return variable <= spec::Variable::TimerC;
}

/// Which timers a program makes count down.
class Timers {
public:
  void set_above_0(spec::Variable timer) { down_ |= 1U << static_cast<unsigned>(timer); }
  bool counts_down(spec::Variable timer) const {
    return (down_ >> static_cast<unsigned>(timer) & 1) != 0;
  }

private:
  std::uint32_t down_ = 0;
};

/// A comparison of a sensor, on the left, with a number.
struct SensorQuestion {
  spec::Variable sensor;
  spec::Relation relation; ///< as the robot asks it
  std::int32_t number;
  std::string symbol; ///< as it is written: `>=`
  std::int32_t written;
};

struct SensorAnswer {
  const Rule* rule;
  Message message;
  Message help;
  std::string line; ///< the comparison to write; empty where nobody knows
};

/// What is wrong with a comparison, written as `text`: it is in another unit, asks a timer for one
/// exact value, or has one answer only.
std::optional<SensorAnswer> judge(const SensorQuestion& question, std::string_view text,
                                  const Timers& timers);

} // namespace orb::compiler
