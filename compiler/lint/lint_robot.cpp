#include "compiler/lint/lint_passes.h"
#include "compiler/text/rules.h"
#include "spec/robots.h"

namespace orb::compiler {
namespace {

void lint_word(spec::Robot robot, std::string_view word, Span span, Findings& findings) {
  if (const auto* lack = spec::find_lack(robot, word))
    findings.add(rules::RobotLacks, span,
                 texts::RobotHasNo(spec::info(robot).title, word, texts::of_table(lack->why)));
}

} // namespace

void lint_robot(const Program& program, spec::Robot robot, Findings& findings) {
  for (const auto& node : program.nodes)
    if (node.kind == NodeKind::System)
      lint_word(robot, spec::info(static_cast<spec::Variable>(node.what)).word, node.span,
                findings);
  for (const auto& statement : program.statements) {
    if (statement.error)
      continue;
    lint_word(robot, spec::info(statement.kind).word, statement.word, findings);
    for (const auto& item : program.items_of(statement))
      if (item.kind == ItemKind::System)
        lint_word(robot, spec::info(static_cast<spec::Variable>(item.value)).word, item.span,
                  findings);
  }
}

std::vector<Diagnostic> robot_findings(const Program& program, spec::Robot robot) {
  Findings findings;
  lint_robot(program, robot, findings);
  return std::move(findings.all());
}

} // namespace orb::compiler
