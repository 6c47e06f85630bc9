#include "run/tether/streamed.h"

namespace orb::run {
namespace {

void note(Streamed& streamed, spec::Variable variable) {
  using enum spec::Variable;
  if (variable == AccelX || variable == AccelY || variable == AccelZ || variable == Accelone ||
      variable == Dshake)
    streamed.acceleration = true;
  else if (variable == GyroX || variable == GyroY || variable == GyroZ)
    streamed.rotation = true;
  else if (variable == Qzero || variable == Qone || variable == Qtwo || variable == Qthree)
    streamed.attitude = true;
}

} // namespace

Streamed read_by(std::span<const Input> inputs) {
  Streamed streamed{false, false, false};
  for (const auto& input : inputs)
    if (input.program)
      for (const auto& node : input.program->parsed.nodes)
        if (node.kind == compiler::NodeKind::System)
          note(streamed, static_cast<spec::Variable>(node.what));
  return streamed;
}

} // namespace orb::run
