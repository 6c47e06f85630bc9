#include "structured/meaning/checker.h"

// Functions that return no value, and subs that do: each was meant as the other.

namespace orb::structured {

bool gives_value(const Program& program, const Names& names, std::uint32_t routine) {
  for (auto i = names.routines[routine].statement; i < program.statements.size(); ++i) {
    const auto& statement = program.statements[i];
    if (names.routine_of[i] != routine)
      return false;
    if (statement.kind == Kind::Return && statement.items_begin != statement.items_end)
      return true;
    if (statement.kind == Kind::Broken)
      return true; // it may be one
  }
  return false;
}

void turn(const Program& program, const Names& names, std::uint32_t routine, SymbolKind into,
          Diagnostic& finding) {
  const auto& begin = program.statements[names.routines[routine].statement];
  const bool function = into == SymbolKind::Function;
  const std::string word = function ? "function" : "sub";
  const auto line = fmt::format("{}{}", word, program.text_of({begin.word.end, begin.span.end}));
  finding.help =
      function ? texts::MakeFunction(line, "end " + word) : texts::MakeSub(line, "end " + word);
  if (begin.next == none)
    return;
  const auto end = program.statements[begin.next].span;
  finding.fix = Fix{function ? texts::ItAFunction() : texts::ItASub(),
                    {{begin.word, word}, {end, "end " + word}},
                    Safety::Unsafe};
}

void Checker::check_values() {
  if (any_error(program_.diagnostics))
    return; // its value may be the mistake
  for (std::uint32_t n = 1; n < names_.routines.size(); ++n) {
    const auto& symbol = names_.symbols[names_.routines[n].symbol];
    if (symbol.kind != SymbolKind::Function || !symbol.used || gives_value(program_, names_, n))
      continue;
    std::string_view value = "e"; // the last value it computes
    const auto& begin = at(names_.routines[n].statement);
    for (auto i = names_.routines[n].statement; i < begin.next && begin.next != none; ++i)
      if (at(i).kind == Kind::Assign)
        value = program_.text_of(item(at(i), 0).span);
    report(rules::NoValue, symbol.span, texts::NeverReturns(program_.name(symbol.name)),
           texts::AddBefore(fmt::format("return {}", value), "end function"));
  }
}

} // namespace orb::structured
