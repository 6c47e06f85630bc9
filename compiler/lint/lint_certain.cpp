#include "compiler/analyse/trial_run.h"
#include "compiler/lint/lint_passes.h"
#include "compiler/text/rules.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace orb::compiler {
namespace {

/// True if the letter of an unbounded sum appears at `span`.
bool is_about(const Program& program, const Diagnostic& grown, Span span) {
  return std::any_of(
      program.statements.begin(), program.statements.end(), [&](const StatementNode& statement) {
        if (statement.error || statement.kind != spec::Statement::Let)
          return false;
        const auto let = program.as<LetView>(statement);
        return let.expression.span == grown.span && let.variable.kind == ItemKind::Letter &&
               std::any_of(program.nodes.begin(), program.nodes.end(), [&](const Node& node) {
                 return node.kind == NodeKind::Letter && node.what == let.variable.value &&
                        meets(node.span, span);
               });
      });
}

/// True if a finding warns of this certain fault.
bool warns_of(const Program& program, const Diagnostic& d, const TrialFault& fault) {
  if (d.rule == &rules::HeadingGrows || d.rule == &rules::ValueGrows)
    return is_about(program, d, fault.span);
  return meets(d.span, fault.span) &&
         (d.rule == fault.rule || d.rule == &rules::LoopLeavesRange ||
          d.rule == &rules::MayLeaveRange || d.rule == &rules::IndexBeforeY);
}

/// True if a finding says why a loop does not end.
bool keeps_looping(const Diagnostic& d) {
  return d.rule == &rules::EndlessLoop || d.rule == &rules::LoopVariableSet ||
         d.rule == &rules::StaleSensor || d.rule == &rules::InvertedWait;
}

/// Adds the tests that lead to a fault as notes, the last one first.
void add_ways(Diagnostic& d, const Trial& trial, std::uint32_t decision) {
  constexpr std::size_t most = 2;
  for (; decision != none && d.notes.size() < most; decision = trial.decisions[decision].before)
    if (const auto& one = trial.decisions[decision];
        one.span.size() > 0 && std::none_of(d.notes.begin(), d.notes.end(), [&](const auto& note) {
          return note.span == one.span;
        }))
      add_note(d, one.span, Message(*one.when, {}));
}

/// Reports a fault on the only path, unless a finding at its place already covers it: that finding
/// becomes an error.
void add_certain(const Program& program, const TrialFault& fault, Findings& findings) {
  bool warned = false;
  for (auto& d : findings.all())
    if (warns_of(program, d, fault)) {
      d.severity = Severity::Error;
      warned = true;
    }
  if (!warned)
    findings.add(*fault.rule, fault.span, fault.message, fault.help).severity = Severity::Error;
}

/// The same for a fault that other paths avoid.
void add_possible(const Program& program, const TrialFault& fault, const Trial& trial,
                  Findings& findings) {
  const auto& all = findings.all();
  const bool endless = fault.rule == &rules::EndlessLoop;
  if (std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) {
        return (endless && keeps_looping(d)) ||
               (d.severity != Severity::Info && meets(d.span, fault.span)) ||
               warns_of(program, d, fault);
      }))
    return;
  auto& d = findings.add(*fault.rule, fault.span, fault.message, fault.help);
  d.severity = Severity::Warning;
  add_ways(d, trial, fault.decision);
}

} // namespace

void lint_certain(const Program& program, const Flow& flow, Findings& findings) {
  const auto trial = try_program(program, flow);
  for (const auto& fault : trial.faults) {
    const auto& all = findings.all();
    const bool said = std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) {
      return is_error(d) && meets(d.span, fault.span);
    });
    if (said)
      continue;
    // The other rules concern lines that fail on their first pass.
    const bool runs_first = fault.later && fault.rule != &rules::MayLeaveRange;
    if (fault.decision == none && !runs_first && fault.certain)
      add_certain(program, fault, findings);
    else
      add_possible(program, fault, trial, findings);
  }
}

} // namespace orb::compiler
