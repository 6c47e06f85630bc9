#include "run/tether/wants.h"

namespace orb::run {
namespace {

void note(Wants& wants, spec::Variable variable) {
  using enum spec::Variable;
  if (variable == AccelX || variable == AccelY || variable == AccelZ || variable == Accelone ||
      variable == Dshake)
    wants.acceleration = true;
  else if (variable == GyroX || variable == GyroY || variable == GyroZ)
    wants.rotation = true;
  else if (variable == Qzero || variable == Qone || variable == Qtwo || variable == Qthree)
    wants.attitude = true;
}

} // namespace

Wants wants_of(std::span<const Input> inputs) {
  Wants wants{false, false, false};
  for (const auto& input : inputs)
    if (input.program)
      for (const auto& node : input.program->parsed.nodes)
        if (node.kind == compiler::NodeKind::System)
          note(wants, static_cast<spec::Variable>(node.what));
  return wants;
}

} // namespace orb::run
