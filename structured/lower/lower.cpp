#include "structured/lower/lower.h"

#include "structured/lower/lowering.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace lowering {
Code Lowering::run() {
  contexts_.emplace_back();
  const auto& main = program_.files.front();
  block(main.statements_begin, main.statements_end);
  emit(LineKind::Do).robot = spec::Statement::End;
  // Called routines follow the main program; they may call others.
  for (std::size_t n = 0; n < called_.size() && !full(); ++n)
    routine(called_[n]);
  code_.too_large = full();
  return std::move(code_);
}

// ---- lines

CodeLine& Lowering::emit(LineKind kind) {
  auto& line = code_.lines.emplace_back();
  line.kind = kind;
  line.origin = origin_;
  line.expansion = expansion_;
  line.routine = static_cast<std::uint16_t>(std::min<std::uint32_t>(written_, 0xFFFF));
  return line;
}

void Lowering::let(std::uint32_t variable, std::uint32_t term) {
  auto& line = emit(LineKind::Let);
  line.variable = variable;
  line.term = term;
}

std::uint32_t Lowering::into_temporary(std::uint32_t term) {
  const auto variable = code_.new_variable();
  let(variable, term);
  return variable;
}

std::uint32_t Lowering::read_temporary(std::uint32_t term) {
  return written_as(code_.terms[term].source, code_.read(into_temporary(term)));
}

std::uint32_t Lowering::written_as(Span source, std::uint32_t term) {
  code_.terms[term].source = source;
  return term;
}

std::uint32_t Lowering::kept(std::uint32_t term) {
  return code_.is_number(term) ? term : read_temporary(term);
}

void Lowering::go_if(Comparison comparison, std::uint32_t left, std::uint32_t right,
                     std::uint32_t label) {
  Condition condition;
  condition.first = {comparison, left, right, {}, {}};
  code_.conditions.push_back(condition);
  auto& line = emit(LineKind::If);
  line.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
  line.label = label;
}

std::uint32_t Lowering::variable_of(std::uint32_t symbol) {
  auto& variable = variable_of_[symbol];
  if (variable == none) {
    variable = code_.new_variable();
    code_.variables[variable].symbol = symbol;
  }
  return variable;
}

// ---- calls

void Lowering::push_call(std::uint32_t n) {
  const auto symbol = names_.of_node[n];
  if (symbol == none) {
    pending_.resize(pending_.size() - program_.nodes[n].count);
    push(code_.number(0));
    return;
  }
  const auto routine = names_.symbols[symbol].routine;
  call_routine(routine, program_.nodes[n].count);
  push(code_.read(result(routine)));
}

std::uint32_t Lowering::result(std::uint32_t routine) {
  auto& variable = result_of_[routine];
  if (variable == none)
    variable = code_.new_variable();
  return variable;
}

void Lowering::call_routine(std::uint32_t routine, std::size_t count) {
  const auto below = pending_.size() - count;
  settle_calls(below);
  const auto& callee = names_.routines[routine];
  for (std::size_t n = 0; n < count; ++n)
    let(variable_of(callee.first_parameter + static_cast<std::uint32_t>(n)), pending_[below + n]);
  pending_.resize(below);
  if (plan_.inlined[routine] && contexts_.size() <= deepest_inline && !full()) {
    const auto end = new_label();
    contexts_.push_back({routine, end, {}, loops_.size()});
    const auto around = expansion_;
    expansion_ = static_cast<std::uint32_t>(code_.expansions.size());
    code_.expansions.push_back({around, origin_, routine});
    body(routine);
    expansion_ = around;
    contexts_.pop_back();
    label(end);
    return;
  }
  if (code_.routines[routine] == none) {
    code_.routines[routine] = new_label();
    called_.push_back(routine);
  }
  auto& line = emit(LineKind::Gosub);
  line.label = code_.routines[routine];
  line.variable = routine;
}

void Lowering::routine(std::uint32_t routine) {
  written_ = routine;
  origin_ = names_.routines[routine].statement;
  label(code_.routines[routine]);
  contexts_.assign(1, {routine, none, {}, 0});
  body(routine);
  emit(LineKind::Return);
}

void Lowering::body(std::uint32_t routine) {
  const auto& callee = names_.routines[routine];
  const auto saved = origin_;
  origin_ = callee.statement;
  for (const auto local : callee.locals)
    let(variable_of(local), code_.number(0));
  const auto end = at(callee.statement).next;
  block(callee.statement + 1, end);
  const auto& symbol = names_.symbols[callee.symbol];
  if (symbol.kind == SymbolKind::Function) {
    origin_ = end;
    let(result(routine), code_.number(0));
  }
  origin_ = saved;
}

} // namespace lowering

Code lower(const Program& program, const Names& names, const Plan& plan) {
  return lowering::Lowering(program, names, plan).run();
}

} // namespace orb::structured
