#include "assembler/operands.h"

#include "assembler/text/rules.h"
#include "base/text/suggest.h"
#include "base/text/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::assembler {

using spec::MacroCommand;
using spec::MacroOperand;
using spec::MacroOperandKind;
using spec::MacroUnit;

namespace {

/// How many thousandths of the operand's own unit one of `unit` is; 0 where they do not go
/// together.
std::int64_t scale(const Unit* unit, MacroUnit own) {
  if (unit == nullptr)
    return whole;
  const auto step = own == MacroUnit::Milliseconds ? unit::ms.steps
                    : own == MacroUnit::Ticks10ms  ? 10 * unit::ms.steps
                                                   : unit::deg.steps;
  const auto measure = own == MacroUnit::Degrees ? Measure::Angle : Measure::Time;
  return own == MacroUnit::None || unit->measure != measure ? 0 : whole * unit->steps / step;
}

std::string range_of(const MacroOperand& operand) {
  const auto unit = spec::to_string(operand.unit);
  if (operand.unit == MacroUnit::Ticks10ms)
    return fmt::format("{} to {} ms in steps of 10", operand.minimum * 10, operand.maximum * 10);
  return fmt::format("{} to {}{}{}", operand.minimum, operand.maximum, unit.empty() ? "" : " ",
                     unit);
}

/// An angle within one turn.
std::int64_t same_way(std::int64_t angle_deg, std::int64_t turn_deg) {
  return (angle_deg % turn_deg + turn_deg) % turn_deg;
}

std::string operand_list(const spec::MacroCommandInfo& info) {
  std::string list;
  for (const auto& operand : info)
    list += fmt::format("{}{}", list.empty() ? "" : ", ",
                        operand.kind == MacroOperandKind::Delay ? fmt::format("[{}]", operand.name)
                                                                : std::string(operand.name));
  return list;
}

/// The lines that wait as long; empty for what would be a page of them.
std::string waits_for(std::int64_t ms) {
  constexpr std::int64_t most_lines = 9;
  const auto& delay = spec::info(MacroCommand::Delay);
  const std::int64_t most = delay.operand[0].maximum;
  const auto lines = (ms + most - 1) / most;
  if (ms < 0 || lines > most_lines)
    return {};
  return lines < 2 ? fmt::format("put `{} {}` on the next line", delay.mnemonic, ms)
                   : fmt::format("put `{} {}` on each of the next {} lines", delay.mnemonic,
                                 ms / lines, lines);
}

} // namespace

std::optional<Bound> Operands::bind(const Statement& statement,
                                    const spec::MacroCommandInfo& info) {
  Bound bound{};
  std::size_t position = 0;
  bool named = false;
  for (const auto& value : program_.values_of(statement)) {
    std::size_t i = position;
    if (value.name.size() != 0) {
      named = true;
      i = 0;
      while (i < info.operand_count && info.operand[i].name != program_.text_of(value.name))
        ++i;
      if (i == info.operand_count) {
        unknown_operand(info, value.name);
        return std::nullopt;
      }
    } else if (named) {
      findings_.add(rules::OperandCount, value.span, "positional operand after a named one",
                    fmt::format("`{}` takes {}", info.mnemonic, operand_list(info)));
      return std::nullopt;
    } else if (position == info.operand_count) {
      findings_.add(rules::OperandCount, value.span,
                    info.operand_count == 0
                        ? fmt::format("`{}` takes no operands", info.mnemonic)
                        : fmt::format("`{}` takes {}, found {}", info.mnemonic,
                                      plural(info.operand_count, "operand"), statement.count),
                    info.operand_count == 0
                        ? std::string()
                        : fmt::format("its operands are {}", operand_list(info)));
      return std::nullopt;
    }
    if (bound[i] != nullptr) {
      findings_.add(rules::OperandCount, value.span,
                    fmt::format("duplicate operand `{}`", info.operand[i].name));
      return std::nullopt;
    }
    bound[i] = &value;
    ++position;
  }
  for (std::size_t i = 0; i < info.operand_count; ++i)
    if (bound[i] == nullptr && info.operand[i].kind != MacroOperandKind::Delay) {
      findings_.add(
          rules::OperandCount, statement.span,
          fmt::format("`{}` is missing its operand `{}`", info.mnemonic, info.operand[i].name),
          fmt::format("it takes {}, as in `{}`", operand_list(info), info.example));
      return std::nullopt;
    }
  return bound;
}

void Operands::unknown_operand(const spec::MacroCommandInfo& info, Span span) {
  std::array<std::string_view, spec::macro_max_operands> names;
  for (std::size_t i = 0; i < info.operand_count; ++i)
    names[i] = info.operand[i].name;
  const auto meant = closest(program_.text_of(span), std::span(names).first(info.operand_count));
  auto& diagnostic = findings_.add(
      rules::UnknownOperand, span,
      fmt::format("`{}` has no operand `{}`", info.mnemonic, program_.text_of(span)),
      meant                     ? fmt::format("did you mean `{}`?", *meant)
      : info.operand_count == 0 ? "it has none"
                                : fmt::format("its operands are {}", operand_list(info)));
  if (meant)
    diagnostic.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
}

const spec::MacroCommandInfo* Operands::roll_for(const Value& delay) const {
  const auto& roll = spec::info(MacroCommand::Roll);
  const auto& roll2 = spec::info(MacroCommand::Roll2);
  const auto* number = names_.number(delay);
  const auto per =
      number == nullptr || !number->is_known ? 0 : scale(number->unit, roll2.operand[2].unit);
  return per > 0 && number->thousandths / whole * per / whole > roll.operand[2].maximum ? &roll2
                                                                                        : &roll;
}

std::optional<std::int32_t> Operands::resolve(const Value& value, const MacroOperand& operand,
                                              std::string_view command) {
  if (operand.kind == MacroOperandKind::Text)
    return std::nullopt;
  if (value.kind == Value::Kind::Number)
    return to_number(value, value.span, operand, command);
  if (value.kind == Value::Kind::Text) {
    findings_.add(rules::OutOfRange, value.span,
                  fmt::format("`{}` of `{}` must be a number, found text", operand.name, command));
    return std::nullopt;
  }
  const auto word = program_.text_of(value.span);
  for (const auto* known = operand.begin_words(); known != operand.end_words(); ++known)
    if (known->word == word)
      return known->value;
  const auto* name = names_.find(word);
  if (name == nullptr)
    return unknown_name(value.span, operand, command);
  if (name->kind == Name::Kind::Macro)
    return macro_id(value.span, *name, operand);
  if (name->value.kind == Value::Kind::Number)
    return to_number(name->value, value.span, operand, command);
  if (name->value.kind == Value::Kind::Word) {
    const auto meaning = program_.text_of(name->value.span);
    for (const auto* known = operand.begin_words(); known != operand.end_words(); ++known)
      if (known->word == meaning)
        return known->value;
  }
  return unknown_name(value.span, operand, command);
}

std::optional<std::int32_t> Operands::macro_id(Span span, const Name& name,
                                               const MacroOperand& operand) {
  if (operand.kind != MacroOperandKind::MacroId) {
    findings_.add(rules::UnknownName, span,
                  fmt::format("`{}` is a macro, but `{}` takes a number", program_.text_of(span),
                              operand.name));
    return std::nullopt;
  }
  const auto& target = names_.macros()[name.macro];
  if (target.id)
    return *target.id;
  if (names_.macros().size() == 1)
    return spec::macro_id_temporary;
  findings_
      .add(
          rules::UnknownName, span,
          fmt::format("`{}` has no id to jump to", program_.text_of(span)),
          fmt::format("write `.macro {} id={}`", program_.text_of(span), spec::macro_id_user_first))
      .notes.push_back({target.span, "defined here"});
  return std::nullopt;
}

std::optional<std::int32_t> Operands::unknown_name(Span span, const MacroOperand& operand,
                                                   std::string_view command) {
  std::vector<std::string_view> known;
  for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
    known.push_back(word->word);
  for (const auto& [name, meaning] : names_.all())
    if (meaning.kind == Name::Kind::Constant || operand.kind == MacroOperandKind::MacroId)
      known.push_back(name);
  std::sort(known.begin() + operand.word_count, known.end());
  const auto meant = closest(program_.text_of(span), known);
  std::string help;
  if (meant)
    help = fmt::format("did you mean `{}`?", *meant);
  else if (operand.word_count > 0 && operand.kind != MacroOperandKind::MacroId)
    for (std::size_t i = 0; i < operand.word_count; ++i)
      help += fmt::format("{}`{}`", i == 0 ? "it is one of " : ", ", operand.words[i].word);
  else if (operand.kind == MacroOperandKind::MacroId)
    help = fmt::format("define it with `.macro {} id={}`, or write an id", program_.text_of(span),
                       spec::macro_id_user_first);
  else
    help = fmt::format("`{}` is {}; `.const {} = {}` gives the name a value", operand.name,
                       range_of(operand), program_.text_of(span), operand.maximum);
  auto& diagnostic = findings_.add(rules::UnknownName, span,
                                   fmt::format("`{}` is not a valid `{}` for `{}`",
                                               program_.text_of(span), operand.name, command),
                                   help);
  if (meant)
    diagnostic.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
  return std::nullopt;
}

std::optional<std::int32_t> Operands::to_number(const Value& number, Span span,
                                                const MacroOperand& operand,
                                                std::string_view command) {
  const auto per = scale(number.unit, operand.unit);
  if (!number.is_known || per == 0) {
    wrong_unit(number, span, operand, command);
    return std::nullopt;
  }
  // Thousandths of a number times thousandths of the own unit: bounded far below 2^63.
  const auto millionths = number.thousandths * per;
  if (millionths % (whole * whole) != 0) {
    findings_.add(
        rules::OutOfRange, span,
        fmt::format("`{}` of `{}` takes whole {}, found `{}`", operand.name, command,
                    operand.unit == MacroUnit::None ? "numbers" : spec::to_string(operand.unit),
                    program_.text_of(span)));
    return std::nullopt;
  }
  const auto value = millionths / (whole * whole);
  if (value >= operand.minimum && value <= operand.maximum)
    return static_cast<std::int32_t>(value);
  out_of_range(value, number, span, operand, command);
  return std::nullopt;
}

void Operands::wrong_unit(const Value& number, Span span, const MacroOperand& operand,
                          std::string_view command) {
  if (!number.is_known) {
    const auto word = program_.text_of(number.span);
    const bool hex = word.ends_with('h') || word.ends_with('H');
    findings_.add(rules::WrongUnit, span, fmt::format("`{}` is not a number", word),
                  hex ? fmt::format("write hexadecimal as `0x{}`", word.substr(0, word.size() - 1))
                      : "the units are `ms`, `s` and `deg`; a number has at most three decimals");
    return;
  }
  findings_.add(rules::WrongUnit, span,
                fmt::format("`{}` of `{}` does not take the unit `{}`", operand.name, command,
                            number.unit->word),
                fmt::format("it must be {}", range_of(operand)));
}

void Operands::out_of_range(std::int64_t value, const Value& number, Span span,
                            const MacroOperand& operand, std::string_view command) {
  const bool is_exact = std::abs(number.thousandths) < largest_number * whole;
  std::string help;
  if (operand.kind == MacroOperandKind::Delay)
    help = waits_for(value);
  else if (is_exact && operand.unit == MacroUnit::Degrees && !operand.is_signed)
    help = fmt::format("{} deg is the same direction", same_way(value, operand.maximum + 1));
  else if (operand.word_count > 0)
    for (std::size_t i = 0; i < operand.word_count; ++i)
      help += fmt::format("{}`{}`", i == 0 ? "it is one of " : ", ", operand.words[i].word);
  auto& d = findings_.add(
      rules::OutOfRange, span,
      fmt::format("`{}` of `{}` must be {}, found {}", operand.name, command, range_of(operand),
                  is_exact ? std::to_string(value) : fmt::format("`{}`", program_.text_of(span))),
      help);
  const bool brightness = operand.name == "red" || operand.name == "green" ||
                          operand.name == "blue" || operand.name == "value";
  if (!is_exact || operand.word_count > 0 || operand.unit == MacroUnit::Milliseconds ||
      operand.kind == MacroOperandKind::MacroId || number.span != span ||
      (value < operand.minimum && operand.unit == MacroUnit::None && !brightness))
    return; // nobody knows which word, which macro, what less than nothing is, or how to wait so
            // long
  const auto near = operand.unit == MacroUnit::Degrees && !operand.is_signed
                        ? same_way(value, operand.maximum + 1)
                        : std::clamp<std::int64_t>(value, operand.minimum, operand.maximum);
  d.fix = Fix{fmt::format("write `{}`", near), {{span, std::to_string(near)}}, Safety::Unsafe};
}

std::string Operands::read_text(const Value& value) {
  if (value.kind != Value::Kind::Text) {
    findings_.add(rules::OutOfRange, value.span, "a comment needs text in quotes",
                  fmt::format("write `comment \"{}\"`", program_.text_of(value.span)));
    return {};
  }
  const auto quoted = program_.text_of(value.span);
  std::string out;
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    if (quoted[i] != '\\') {
      out += quoted[i];
      continue;
    }
    switch (quoted[++i]) {
    case 'n': out += '\n'; break;
    case 'r': out += '\r'; break;
    case 't': out += '\t'; break;
    case '0': out += '\0'; break;
    case 'x':
      out += static_cast<char>((*from_hex(quoted.substr(i + 1, 2)))[0]);
      i += 2;
      break;
    default: out += quoted[i];
    }
  }
  return out;
}

} // namespace orb::assembler
