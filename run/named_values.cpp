#include "run/named_values.h"

#include "bytecode/chunk.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

using compiler::ItemKind;
using compiler::NodeKind;

/// Calls `call` with the number and statements of each line that runs.
template <class Call>
void each_line(const compiler::Program& program, Call call) {
  for (const auto& line : program.lines)
    if (line.has_number() && line.has_statement())
      call(static_cast<int>(line.number), program.whole(program.statements[line.statement]));
}

bool sets_element(const compiler::Program& program,
                  std::span<const compiler::StatementNode> statements) {
  for (const auto& one : statements)
    for (const auto& item : program.items_of(one))
      if (!one.error && item.kind == ItemKind::Indexed)
        return true;
  return false;
}

} // namespace

NamedValues::NamedValues(const Program& program, report::Journey& journey) {
  Known known;
  if (program.compiled)
    take_symbols(*program.compiled, known);
  else
    take_letters(program.parsed, known);
  take_elements(program.parsed, program.compiled.get(), known);
  journey.set_variables(known);
}

/// A letter can change only in lines that set it.
void NamedValues::take_letters(const compiler::Program& program, Known& known) {
  std::map<std::uint32_t, std::size_t> variables;
  each_line(program, [&](int number, auto statements) {
    for (const auto& one : statements)
      for (const auto& item : program.items_of(one)) {
        if (one.error || item.kind != ItemKind::Letter)
          continue;
        const auto [at, fresh] = variables.try_emplace(item.value, known.size());
        if (fresh)
          known.emplace_back(std::string(1, spec::letter_name(item.value)), "");
        lines_[number].bindings.push_back({item.value, at->second});
      }
  });
}

void NamedValues::take_symbols(const structured::Compiled& compiled, Known& known) {
  std::map<std::uint32_t, std::size_t> variables;
  for (const auto& line : compiled.robot.lines)
    for (auto n = line.names_begin; n < line.names_end; ++n) {
      const auto [letter, symbol] = compiled.robot.names[n];
      const auto [at, fresh] = variables.try_emplace(symbol, known.size());
      if (fresh) {
        const auto& named = compiled.names.symbols[symbol];
        const bool own = named.kind == structured::SymbolKind::Local ||
                         named.kind == structured::SymbolKind::Parameter;
        const auto owner = own ? compiled.names.routines[named.routine].symbol : structured::none;
        known.emplace_back(compiled.program.name(named.name),
                           owner == structured::none ? std::string()
                                                     : std::string(compiled.program.name(
                                                           compiled.names.symbols[owner].name)));
      }
      lines_[static_cast<int>(line.number)].bindings.push_back({letter, at->second});
    }
}

/// Adds array elements, or elements of Z in a numbered program, if any line sets one.
void NamedValues::take_elements(const compiler::Program& program,
                                const structured::Compiled* compiled, Known& known) {
  bool any = false;
  each_line(program, [&](int number, auto statements) {
    if (sets_element(program, statements))
      any = lines_[number].sets_element = true;
  });
  if (!any)
    return;
  const auto take = [&](std::size_t element, std::string name) {
    if (elements_.try_emplace(element, known.size()).second)
      known.emplace_back(std::move(name), "");
  };
  if (compiled == nullptr) {
    for (std::size_t element = 1; element <= bytecode::element_count; ++element)
      take(element, fmt::format("Z[{}]", element));
    return;
  }
  for (const auto& symbol : compiled->names.symbols)
    if (symbol.kind == structured::SymbolKind::Array)
      for (std::int32_t i = 1; i <= symbol.value; ++i)
        take(static_cast<std::size_t>(symbol.base + i),
             fmt::format("{}[{}]", compiled->program.name(symbol.name), i));
}

void NamedValues::line_ended(Duration t, int line, const vm::Machine& machine,
                             report::Journey& journey) const {
  const auto found = lines_.find(line);
  if (found == lines_.end())
    return;
  for (const auto& [place, variable] : found->second.bindings)
    journey.note(t, variable, machine.variable(place));
  if (!found->second.sets_element)
    return;
  const auto element = machine.variable(bytecode::index_variable);
  const auto variable = elements_.find(static_cast<std::size_t>(element));
  if (element > 0 && variable != elements_.end())
    journey.note(t, variable->second,
                 machine.variable(bytecode::first_element + static_cast<std::size_t>(element) - 1));
}

} // namespace orb::run
