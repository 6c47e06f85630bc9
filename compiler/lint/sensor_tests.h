#pragma once

#include "base/message.h"
#include "base/rules.h"
#include "compiler/analyse/orders.h"
#include "spec/basic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace orb::compiler {

constexpr bool is_timer(spec::Variable variable) {
  return variable <= spec::Variable::TimerC;
}

/// The timers that a program makes count down.
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
  Orders orders;
  std::int32_t number;
  bool has_unit;            ///< a unit is written behind the number
  std::string_view unequal; ///< the sign of the language, as for `sign_of()`
};

struct SensorAnswer {
  const Rule* rule;
  Message message;
  Message help;
  std::string line; ///< the replacement; empty if unknown
};

/// Checks a comparison, written as `text`: reports a wrong unit, a timer tested for one exact
/// value, and a constant result.
std::optional<SensorAnswer> judge(const SensorQuestion& question, std::string_view text,
                                  const Timers& timers);

} // namespace orb::compiler
