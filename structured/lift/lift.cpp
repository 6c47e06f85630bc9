#include "structured/lift/lift.h"

#include "compiler/text/rules.h"
#include "structured/compile.h"
#include "structured/lift/choices.h"
#include "structured/lift/write_text.h"
#include "structured/lower/lower.h"
#include "structured/meaning/check.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/known_values.h"
#include "structured/text/read.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"

#include <algorithm>

namespace orb::structured {
namespace {

using lifting::LiftedText;
using lifting::Proofs;

/// Analyses a lifted program with the compiler: proves which loops run at least once, and which
/// selects always find a case.
class Prover {
public:
  explicit Prover(const LiftedText& lifted) : lifted_(lifted) {
    NoFiles files;
    program_ = read("", "", lifted.text, files);
    names_ = resolve(program_);
    check(program_, names_);
  }

  /// Returns true if all loops of the text are proven; marks the others in `proofs`.
  bool prove_loops(Proofs& proofs) {
    lower_plainly();
    bool all = true;
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i)
      if (program_.statements[i].kind == Kind::For) {
        const auto step = lifted_.loops[n++];
        if (counts(i))
          continue;
        proofs.counted[step] = false;
        all = false;
      }
    return all;
  }

  void prove_choices(Proofs& proofs) const {
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i)
      if (program_.text_of(program_.statements[i].span).starts_with(lifting::stopper)) {
        const auto step = lifted_.choices[n++];
        proofs.covered[step] = !has_line(i, LineKind::SetElement);
      }
  }

private:
  void lower_plainly() {
    const bool sound = std::none_of(
        program_.diagnostics.begin(), program_.diagnostics.end(), [](const Diagnostic& found) {
          return found.severity == Severity::Error && found.rule != &rules::LoopVariable;
        });
    if (!sound)
      return;
    Plan plan;
    plan.inlined.assign(names_.routines.size(), false);
    plan.needed.assign(names_.routines.size(), true);
    plan.native.assign(program_.statements.size(), true);
    code_ = lower(program_, names_, plan);
    clean_jumps(code_);
    use_values(
        code_,
        BranchChanges::AsTheyAre); // otherwise a test could be threaded away on one path only
    clean_jumps(code_);
  }

  bool has_line(std::uint32_t statement, LineKind kind) const {
    return std::any_of(code_.lines.begin(), code_.lines.end(), [&](const CodeLine& line) {
      return line.origin == statement && line.kind == kind;
    });
  }

  /// True if the entry test of a loop was optimised away.
  bool counts(std::uint32_t loop) const {
    const auto span = program_.statements[loop].span;
    const bool nested = std::any_of(
        program_.diagnostics.begin(), program_.diagnostics.end(), [&](const Diagnostic& found) {
          return found.rule == &rules::LoopVariable && found.span.begin >= span.begin &&
                 found.span.end <= span.end;
        });
    return !nested && has_line(loop, LineKind::For) && !has_line(loop, LineKind::If) &&
           !has_line(loop, LineKind::Goto);
  }

  const LiftedText& lifted_;
  Program program_;
  Names names_;
  Code code_;
};

/// Writes the text with the simplest loops and selects that can be proven.
LiftedText write_plainly(const compiler::Program& program, const lifting::ControlFlow& ways,
                         const lifting::Comments& comments,
                         const std::vector<lifting::Graph>& graphs) {
  Proofs proofs{std::vector<bool>(ways.steps.size(), true),
                std::vector<bool>(ways.steps.size(), false)};
  for (;;) {
    auto lifted = lifting::write_text(program, ways, comments, graphs, proofs);
    Prover prover(lifted);
    if (!prover.prove_loops(proofs))
      continue; // terminates: each round gives up at least one `for`
    if (lifted.choices.empty())
      return lifted;
    prover.prove_choices(proofs);
    return lifting::write_text(program, ways, comments, graphs, proofs);
  }
}

void report_left_out(const compiler::Program& program, const lifting::ControlFlow& ways,
                     std::vector<Diagnostic>& findings) {
  for (const auto& step : ways.steps)
    if (step.begins_line && !step.reached) {
      const auto& line = program.lines[step.line];
      findings.push_back(finding(compiler::rules::UnreachableLine, line.number_span,
                                 texts::NeverReached(line.number)));
    }
}

/// Reports the compiler's first error in a lifted text, if there is one.
void report_refused(const compiler::Program& program, const LiftedText& lifted,
                    std::vector<Diagnostic>& findings) {
  NoFiles files;
  const auto compiled = compile("", "", lifted.text, {}, files);
  for (const auto& found : compiled.program.diagnostics)
    if (keeps_from_building(found)) {
      const auto nth = lifting::not_blank(lifted.text, found.span.begin);
      const auto line = nth < lifted.lines.size() ? lifted.lines[nth] : 0;
      findings.push_back(
          lifting::obstacle(program.lines[line].span, texts::LineWouldErr(found.message)));
      return;
    }
}

} // namespace

Lifted lift(const compiler::Checked& checked) {
  const auto& program = checked.program;
  Lifted lifted;
  std::copy_if(checked.diagnostics.begin(), checked.diagnostics.end(),
               std::back_inserter(lifted.findings), is_error);
  if (!lifted.findings.empty())
    return lifted;
  auto ways = lifting::read_ways(program);
  if (ways.steps.empty())
    ways.obstacle = lifting::obstacle({}, texts::ProgramEmpty());
  if (ways.obstacle) {
    lifted.findings.push_back(*ways.obstacle);
    return lifted;
  }
  const auto comments = lifting::read_comments(program, ways);
  std::vector<lifting::Graph> graphs{lifting::make_graph(program, ways, lifting::none)};
  for (const auto first : ways.subroutines)
    graphs.push_back(lifting::make_graph(program, ways, first));
  auto plain = write_plainly(program, ways, comments, graphs);
  report_left_out(program, ways, lifted.findings);
  const auto before = lifted.findings.size();
  report_refused(program, plain, lifted.findings);
  if (lifted.findings.size() == before)
    lifted.text = std::move(plain.text);
  return lifted;
}

} // namespace orb::structured
