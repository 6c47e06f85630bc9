#include "compiler/lint/lint_passes.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"

namespace orb::compiler {
namespace {

/// Reports features that the target firmware does not have yet.
class AgePass {
public:
  AgePass(const Program& program, const Target& target, Findings& findings)
      : program_(program), target_(target), findings_(findings) {}

  void run() {
    for (const auto& statement : program_.statements)
      if (!statement.error)
        check(statement);
    for (const auto& node : program_.nodes)
      if (node.kind == NodeKind::System)
        check_variable(node);
  }

private:
  void check(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    if (statement.kind == spec::Statement::Goroll)
      check_goroll(statement);
    else if (row.since > target_.version)
      add(statement.word, row.word, row.since);
    if (statement.kind == spec::Statement::Let)
      check_timer(program_.as<LetView>(statement));
  }

  /// Before August 2012 it took two values.
  void check_goroll(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const auto values = program_.items_of(statement);
    if (row.since <= target_.version || values.size() < row.parameters().size())
      return;
    add(statement.word, row.word, row.since).help = texts::TookTwoValues(
        program_.text_of({statement.word.begin, values[values.size() - 2].span.end}));
  }

  void check_timer(const LetView& let) {
    const auto& row = spec::info(spec::BasicGrowth::TimersCountUp);
    if (row.since <= target_.version || let.variable.kind != ItemKind::System ||
        !is_timer(static_cast<spec::Variable>(let.variable.value)))
      return;
    const auto& value = program_.nodes[let.expression.value];
    if (value.kind != NodeKind::Number || value.value != 0)
      return;
    auto& d = findings_.add(
        rules::NewerThanTarget, let.variable.span,
        texts::TimersCountUpSince(spec::info(row.since).text, spec::info(target_.version).text),
        texts::SetTimerAndLook());
    d.severity = Severity::Warning;
  }

  void check_variable(const Node& node) {
    const auto& row = spec::variables[node.what];
    if (row.since <= target_.version)
      return;
    const bool renamed = !row.old_word.empty();
    if (renamed && program_.text_of(node.span) == row.old_word)
      return;
    auto& d = add(node.span, row.word, row.since);
    if (renamed)
      d.help = texts::InThatVersionWrite(row.old_word);
  }

  Diagnostic& add(Span span, std::string_view word, spec::BasicVersion since) {
    return findings_.add(
        rules::NewerThanTarget, span,
        texts::NeedsVersion(word, spec::info(since).text, spec::info(target_.version).text));
  }

  const Program& program_;
  const Target& target_;
  Findings& findings_;
};

} // namespace

void lint_age(const Program& program, const Target& target, Findings& findings) {
  AgePass(program, target, findings).run();
}

} // namespace orb::compiler
