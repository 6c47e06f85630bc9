#include "editor/languages/macro/macro_names.h"

#include "spec/macro.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

using assembler::Program;
using assembler::Statement;
using assembler::Value;

bool is_own_word(const spec::MacroOperand* operand, std::string_view word) {
  return operand != nullptr &&
         std::any_of(operand->begin_words(), operand->end_words(),
                     [&](const spec::MacroWord& one) { return one.word == word; });
}

bool is_flag(std::string_view word) {
  return std::any_of(std::begin(spec::macro_flags), std::end(spec::macro_flags),
                     [&](const spec::MacroFlagInfo& row) { return row.word == word; });
}

} // namespace

const spec::MacroOperand* operand_of(const Source& source, const Program& program,
                                     const Statement& statement, std::uint32_t index) {
  if (statement.info == nullptr)
    return nullptr;
  const auto& value = program.values_of(statement)[index];
  if (value.name.size() > 0) {
    for (const auto& operand : *statement.info)
      if (operand.name == source.text(value.name))
        return &operand;
    return nullptr;
  }
  return index < statement.info->operand_count ? statement.info->begin() + index : nullptr;
}

std::vector<MacroName> names_in(const Source& source, const Program& program) {
  std::vector<MacroName> names;
  for (const auto& statement : program.statements)
    for (std::uint32_t i = 0; i < statement.count; ++i) {
      const auto& value = program.values_of(statement)[i];
      const bool is_word = value.kind == Value::Kind::Word;
      const auto text = source.text(value.span);
      switch (statement.kind) {
      case Statement::Kind::Const:
        if (value.name.size() > 0)
          names.push_back({value.name, true});
        if (is_word)
          names.push_back({value.span, false});
        break;
      case Statement::Kind::Macro:
        if (i == 0 && is_word && value.name.size() == 0)
          names.push_back({value.span, true});
        else if (is_word && !is_flag(text))
          names.push_back({value.span, false});
        break;
      case Statement::Kind::Command:
        if (is_word && !is_own_word(operand_of(source, program, statement, i), text))
          names.push_back({value.span, false});
        break;
      case Statement::Kind::Raw:
      case Statement::Kind::NoEnd: break;
      }
    }
  return names;
}

std::string range_text(const spec::MacroOperand& operand) {
  if (operand.kind == spec::MacroOperandKind::Text)
    return "text in quotes";
  const auto unit = [&]() -> std::string_view {
    switch (operand.unit) {
    case spec::MacroUnit::None: return "";
    case spec::MacroUnit::Milliseconds: return " ms";
    case spec::MacroUnit::Ticks10ms: return " times 10 ms";
    case spec::MacroUnit::Degrees: return " degrees";
    }
    return "";
  }();
  auto out = fmt::format("{} to {}{}", operand.minimum, operand.maximum, unit);
  for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
    out += fmt::format(", `{}` is {}", word->word, word->value);
  return out;
}

} // namespace orb::editor
