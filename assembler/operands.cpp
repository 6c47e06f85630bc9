#include "assembler/operands.h"

#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/fixes.h"
#include "base/text/suggest.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::assembler {

using spec::MacroCommand;
using spec::MacroOperand;
using spec::MacroOperandKind;
using spec::MacroUnit;

namespace {

/// Thousandths of the operand's own unit in one `unit`; 0 if they measure different things.
std::int64_t scale(const Unit* unit, MacroUnit own) {
  if (unit == nullptr)
    return whole;
  const auto step = own == MacroUnit::Milliseconds ? unit::ms.steps
                    : own == MacroUnit::Ticks10ms  ? 10 * unit::ms.steps
                                                   : unit::deg.steps;
  const auto measure = own == MacroUnit::Degrees ? Measure::Angle : Measure::Time;
  return own == MacroUnit::None || unit->measure != measure ? 0 : whole * unit->steps / step;
}

constexpr int tick_ms = 10;

std::int32_t least_of(const MacroOperand& operand) {
  return operand.unit == MacroUnit::Ticks10ms ? operand.minimum * tick_ms : operand.minimum;
}

/// The maximum of an operand, with its unit: `359 deg`.
Message most_of(const MacroOperand& operand) {
  if (operand.unit == MacroUnit::Ticks10ms)
    return texts::InSteps(fmt::format("{} ms", operand.maximum * tick_ms), tick_ms);
  const auto unit = spec::to_string(operand.unit);
  return Message::as_is(fmt::format("{}{}{}", operand.maximum, unit.empty() ? "" : " ", unit));
}

Message words_of(const MacroOperand& operand) {
  std::string list;
  for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", word->word);
  return texts::ItIsOneOf(list);
}

/// Reduces an angle to one turn.
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

/// The lines that wait equally long; empty if they would be too many.
Message waits_for(std::int64_t ms) {
  constexpr std::int64_t most_lines = 9;
  const auto& delay = spec::info(MacroCommand::Delay);
  const std::int64_t most = delay.operand[0].maximum;
  const auto lines = (ms + most - 1) / most;
  if (ms < 0 || lines > most_lines)
    return {};
  return lines < 2 ? texts::PutBelow(fmt::format("{} {}", delay.mnemonic, ms))
                   : texts::PutOnLines(fmt::format("{} {}", delay.mnemonic, ms / lines), lines);
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
      findings_.add(rules::OperandCount, value.span, texts::PlaceAfterName(),
                    texts::Takes(info.mnemonic, operand_list(info)));
      return std::nullopt;
    } else if (position == info.operand_count) {
      too_many(statement, info, value.span);
      return std::nullopt;
    }
    if (bound[i] != nullptr) {
      findings_.add(rules::OperandCount, value.span, texts::DuplicateOperand(info.operand[i].name));
      return std::nullopt;
    }
    bound[i] = &value;
    ++position;
  }
  for (std::size_t i = 0; i < info.operand_count; ++i)
    if (bound[i] == nullptr && info.operand[i].kind != MacroOperandKind::Delay) {
      findings_.add(rules::OperandCount, statement.span,
                    texts::MissingOperand(info.mnemonic, info.operand[i].name),
                    texts::ItTakes(operand_list(info), info.example));
      return std::nullopt;
    }
  return bound;
}

void Operands::too_many(const Statement& statement, const spec::MacroCommandInfo& info, Span span) {
  if (info.operand_count == 0)
    findings_.add(rules::OperandCount, span, texts::TakesNone(info.mnemonic));
  else
    findings_.add(rules::OperandCount, span,
                  info.operand_count == 1
                      ? texts::TakesOne(info.mnemonic, statement.count)
                      : texts::TakesSeveral(info.mnemonic, info.operand_count, statement.count),
                  texts::OperandsAre(operand_list(info)));
}

void Operands::unknown_operand(const spec::MacroCommandInfo& info, Span span) {
  std::array<std::string_view, spec::macro_max_operands> names;
  for (std::size_t i = 0; i < info.operand_count; ++i)
    names[i] = info.operand[i].name;
  const auto meant = closest(program_.text_of(span), std::span(names).first(info.operand_count));
  auto& diagnostic = findings_.add(
      rules::UnknownOperand, span, texts::NoSuchOperand(info.mnemonic, program_.text_of(span)),
      meant                     ? texts::DidYouMean(*meant)
      : info.operand_count == 0 ? texts::HasNone()
                                : texts::OperandsAre(operand_list(info)));
  if (meant)
    diagnostic.fix = single_fix(texts::Write(*meant), span, *meant, Safety::Unsafe);
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
    findings_.add(rules::OutOfRange, value.span, texts::FoundText(operand.name, command));
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
    findings_.add(rules::UnknownName, span, texts::IsAMacro(program_.text_of(span), operand.name));
    return std::nullopt;
  }
  const auto& target = names_.macros()[name.macro];
  if (target.id)
    return *target.id;
  if (names_.macros().size() == 1)
    return spec::macro_id_temporary;
  const auto above = program_.text.substr(0, target.span.begin);
  const auto line = std::count(above.begin(), above.end(), '\n') + 1;
  findings_
      .add(rules::UnknownName, span, texts::HasNoId(program_.text_of(span)),
           texts::WriteOnLine(macro_line(span), line))
      .notes.push_back({target.span, texts::DefinedHere()});
  return std::nullopt;
}

std::string Operands::macro_line(Span name) const {
  return fmt::format(".macro {} id={}", program_.text_of(name), spec::macro_id_user_first);
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
  const auto word = program_.text_of(span);
  const auto help = meant                                       ? texts::DidYouMean(*meant)
                    : operand.kind == MacroOperandKind::MacroId ? texts::DefineIt(macro_line(span))
                    : operand.word_count > 0
                        ? words_of(operand)
                        : texts::DefineValue(operand.name, least_of(operand), most_of(operand),
                                             fmt::format(".const {} = {}", word, operand.maximum));
  auto& diagnostic =
      findings_.add(rules::UnknownName, span, texts::NotValid(word, operand.name, command), help);
  if (meant)
    diagnostic.fix = single_fix(texts::Write(*meant), span, *meant, Safety::Unsafe);
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
  // Thousandths of a number times thousandths of the own unit: far below 2^63.
  const auto millionths = number.thousandths * per;
  if (millionths % (whole * whole) != 0) {
    const auto unit = operand.unit == MacroUnit::None ? texts::Numbers()
                      : operand.unit == MacroUnit::Ticks10ms
                          ? texts::StepsOf(spec::to_string(operand.unit))
                          : Message::as_is(std::string(spec::to_string(operand.unit)));
    findings_.add(
        rules::OutOfRange, span,
        texts::Found(texts::TakesWhole(operand.name, command, unit), program_.text_of(span)));
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
    if (span.begin == number.span.begin) // a constant was reported where it is defined
      add_no_number(findings_, program_, span);
    return;
  }
  findings_.add(rules::WrongUnit, span, texts::OtherUnit(operand.name, command, number.unit->word),
                texts::MustBe(least_of(operand), most_of(operand)));
}

void Operands::out_of_range(std::int64_t value, const Value& number, Span span,
                            const MacroOperand& operand, std::string_view command) {
  const bool is_exact = std::abs(number.thousandths) < largest_number * whole;
  Message help;
  if (operand.kind == MacroOperandKind::Delay)
    help = waits_for(value);
  else if (is_exact && operand.unit == MacroUnit::Degrees && !operand.is_signed)
    help = texts::SameDirection(same_way(value, operand.maximum + 1));
  else if (operand.word_count > 0)
    help = words_of(operand);
  const auto found = !is_exact ? fmt::format("`{}`", program_.text_of(span))
                     : operand.unit == MacroUnit::Ticks10ms ? fmt::format("{} ms", value * tick_ms)
                                                            : std::to_string(value);
  auto& d = findings_.add(
      rules::OutOfRange, span,
      texts::BeyondRange(operand.name, command, least_of(operand), most_of(operand), found), help);
  const bool brightness = operand.name == "red" || operand.name == "green" ||
                          operand.name == "blue" || operand.name == "value";
  if (!is_exact || operand.word_count > 0 || operand.unit == MacroUnit::Milliseconds ||
      operand.kind == MacroOperandKind::MacroId || number.span != span ||
      (value < operand.minimum && operand.unit == MacroUnit::None && !brightness))
    return; // nothing to propose: the word, the macro or the wait that was meant is unknown
  const auto near = operand.unit == MacroUnit::Degrees && !operand.is_signed
                        ? same_way(value, operand.maximum + 1)
                        : std::clamp<std::int64_t>(value, operand.minimum, operand.maximum);
  d.fix = single_fix(texts::Write(near), span, std::to_string(near), Safety::Unsafe);
}

std::string Operands::read_text(const Value& value) {
  if (value.kind != Value::Kind::Text) {
    const auto quoted = fmt::format("\"{}\"", program_.text_of(value.span));
    auto& d = findings_.add(rules::OutOfRange, value.span, texts::CommentNeedsText(),
                            texts::Write("comment " + quoted));
    d.fix = single_fix(d.help, value.span, quoted, Safety::Unsafe);
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
