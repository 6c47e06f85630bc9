#include "structured/meaning/symbols.h"
#include "structured/text/texts.h"

#include <fmt/format.h>

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

} // namespace orb::structured
