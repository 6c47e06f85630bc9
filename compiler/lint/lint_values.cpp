#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::run(Jumps jumps) {
  collect_letters();
  if (jumps == Jumps::Known && ways_.prepare())
    follow();
  check_lines();
  check_letters();
}

void lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings) {
  ValuesPass(program, flow, target, findings).run(jumps);
}

} // namespace orb::compiler
