#include "assembler/assembler.h"

namespace orb::assembler {

namespace {

std::string_view unit_word(Unit unit) {
  switch (unit) {
  case Unit::None:
  case Unit::Unknown: return "";
  case Unit::Milliseconds: return "ms";
  case Unit::Seconds: return "s";
  case Unit::Degrees: return "deg";
  }
  return "";
}

/// How many thousandths of the operand's own unit one of `unit` is; 0 where they do not go
/// together.
std::int64_t scale(Unit unit, MacroUnit own) {
  if (unit == Unit::None)
    return whole;
  const std::int64_t ms = unit == Unit::Milliseconds ? 1 : unit == Unit::Seconds ? second_ms : 0;
  switch (own) {
  case MacroUnit::None: return 0;
  case MacroUnit::Milliseconds: return whole * ms;
  case MacroUnit::Ticks10ms: return whole * ms / 10;
  case MacroUnit::Degrees: return unit == Unit::Degrees ? whole : 0;
  }
  return 0;
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

} // namespace

bool Assembler::bind(const Statement& statement, const spec::MacroCommandInfo& info,
                     std::array<const Value*, spec::macro_max_operands>& bound) {
  std::size_t position = 0;
  bool named = false;
  for (const auto* value = values(statement); value != values(statement) + statement.count;
       ++value) {
    std::size_t i = position;
    if (value->name.size() != 0) {
      named = true;
      i = 0;
      while (i < info.operand_count && info.operand[i].name != text(value->name))
        ++i;
      if (i == info.operand_count)
        return unknown_operand(info, value->name);
    } else if (named) {
      report(rules::OperandCount, value->span, "positional operand after a named one",
             fmt::format("`{}` takes {}", info.mnemonic, operand_list(info)));
      return false;
    } else if (position == info.operand_count) {
      report(rules::OperandCount, value->span,
             info.operand_count == 0
                 ? fmt::format("`{}` takes no operands", info.mnemonic)
                 : fmt::format("`{}` takes {}, found {}", info.mnemonic,
                               plural(info.operand_count, "operand"), statement.count),
             info.operand_count == 0 ? std::string()
                                     : fmt::format("they are {}", operand_list(info)));
      return false;
    }
    if (bound[i] != nullptr) {
      report(rules::OperandCount, value->span,
             fmt::format("duplicate operand `{}`", info.operand[i].name));
      return false;
    }
    bound[i] = value;
    ++position;
  }
  for (std::size_t i = 0; i < info.operand_count; ++i)
    if (bound[i] == nullptr && info.operand[i].kind != MacroOperandKind::Delay) {
      report(rules::OperandCount, statement.span,
             fmt::format("`{}` is missing its operand `{}`", info.mnemonic, info.operand[i].name),
             fmt::format("it takes {}, as in `{}`", operand_list(info), info.example));
      return false;
    }
  return true;
}

bool Assembler::unknown_operand(const spec::MacroCommandInfo& info, Span span) {
  std::array<std::string_view, spec::macro_max_operands> names;
  for (std::size_t i = 0; i < info.operand_count; ++i)
    names[i] = info.operand[i].name;
  const auto meant = closest(text(span), std::span(names).first(info.operand_count));
  auto& diagnostic =
      report(rules::UnknownOperand, span,
             fmt::format("`{}` has no operand `{}`", info.mnemonic, text(span)),
             meant                     ? fmt::format("did you mean `{}`?", *meant)
             : info.operand_count == 0 ? "it has none"
                                       : fmt::format("they are {}", operand_list(info)));
  if (meant)
    diagnostic.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
  return false;
}

const spec::MacroCommandInfo* Assembler::roll_for(const Value& delay) {
  const auto& roll = spec::info(MacroCommand::Roll);
  const auto& roll2 = spec::info(MacroCommand::Roll2);
  const auto* number = constant(delay);
  const auto per = number == nullptr ? 0 : scale(number->unit, roll2.operand[2].unit);
  return per > 0 && number->thousandths / whole * per / whole > roll.operand[2].maximum ? &roll2
                                                                                        : &roll;
}

const Value* Assembler::constant(const Value& value) const {
  if (value.kind == Value::Kind::Number)
    return &value;
  if (value.kind == Value::Kind::Text)
    return nullptr;
  const auto* name = find_name(text(value.span));
  return name != nullptr && name->kind == Name::Kind::Constant &&
                 name->value.kind == Value::Kind::Number
             ? &name->value
             : nullptr;
}

std::optional<std::int32_t> Assembler::resolve(const Value& value, const MacroOperand& operand,
                                               std::string_view command) {
  if (operand.kind == MacroOperandKind::Text)
    return std::nullopt;
  if (value.kind == Value::Kind::Number)
    return to_number(value, value.span, operand, command);
  if (value.kind == Value::Kind::Text) {
    report(rules::OutOfRange, value.span,
           fmt::format("`{}` of `{}` must be a number, found text", operand.name, command));
    return std::nullopt;
  }
  const auto word = text(value.span);
  for (const auto* known = operand.begin_words(); known != operand.end_words(); ++known)
    if (known->word == word)
      return known->value;
  const auto* name = find_name(word);
  if (name == nullptr)
    return unknown_name(value.span, operand, command);
  if (name->kind == Name::Kind::Macro)
    return macro_id(value.span, *name, operand);
  if (name->value.kind == Value::Kind::Number)
    return to_number(name->value, value.span, operand, command);
  if (name->value.kind == Value::Kind::Word) {
    const auto meaning = text(name->value.span);
    for (const auto* known = operand.begin_words(); known != operand.end_words(); ++known)
      if (known->word == meaning)
        return known->value;
  }
  return unknown_name(value.span, operand, command);
}

std::optional<std::int32_t> Assembler::macro_id(Span span, const Name& name,
                                                const MacroOperand& operand) {
  if (operand.kind != MacroOperandKind::MacroId) {
    report(rules::UnknownName, span,
           fmt::format("`{}` is a macro; `{}` is a number", text(span), operand.name));
    return std::nullopt;
  }
  const auto& target = assembly_.macros[name.macro];
  if (target.id)
    return *target.id;
  if (assembly_.macros.size() == 1)
    return spec::macro_id_temporary;
  report(rules::UnknownName, span, fmt::format("`{}` has no id to jump to", text(span)),
         fmt::format("write `.macro {} id={}`", text(span), spec::macro_id_user_first))
      .notes.push_back({target.span, "defined here"});
  return std::nullopt;
}

std::optional<std::int32_t> Assembler::unknown_name(Span span, const MacroOperand& operand,
                                                    std::string_view command) {
  std::vector<std::string_view> known;
  for (const auto* word = operand.begin_words(); word != operand.end_words(); ++word)
    known.push_back(word->word);
  for (const auto& [name, meaning] : names_)
    if (meaning.kind == Name::Kind::Constant || operand.kind == MacroOperandKind::MacroId)
      known.push_back(name);
  std::sort(known.begin() + operand.word_count, known.end());
  const auto meant = closest(text(span), known);
  std::string help;
  if (meant)
    help = fmt::format("did you mean `{}`?", *meant);
  else if (operand.word_count > 0 && operand.kind != MacroOperandKind::MacroId)
    for (std::size_t i = 0; i < operand.word_count; ++i)
      help += fmt::format("{}`{}`", i == 0 ? "it is one of " : ", ", operand.words[i].word);
  else if (operand.kind == MacroOperandKind::MacroId)
    help = fmt::format("`.macro {} id={}` defines it, or write an id", text(span),
                       spec::macro_id_user_first);
  else
    help = fmt::format("`{}` is {}; `.const {} = {}` gives the name a value", operand.name,
                       range_of(operand), text(span), operand.maximum);
  auto& diagnostic = report(
      rules::UnknownName, span,
      fmt::format("`{}` is not valid as `{}` of `{}`", text(span), operand.name, command), help);
  if (meant)
    diagnostic.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
  return std::nullopt;
}

std::optional<std::int32_t> Assembler::to_number(const Value& number, Span span,
                                                 const MacroOperand& operand,
                                                 std::string_view command) {
  const auto per = scale(number.unit, operand.unit);
  if (number.unit == Unit::Unknown || per == 0) {
    wrong_unit(number, span, operand, command);
    return std::nullopt;
  }
  // Thousandths of a number times thousandths of the own unit: bounded far below 2^63.
  const auto millionths = number.thousandths * per;
  if (millionths % (whole * whole) != 0) {
    report(rules::OutOfRange, span,
           fmt::format("`{}` of `{}` takes whole {}, found `{}`", operand.name, command,
                       operand.unit == MacroUnit::None ? "numbers" : spec::to_string(operand.unit),
                       text(span)));
    return std::nullopt;
  }
  const auto value = millionths / (whole * whole);
  if (value >= operand.minimum && value <= operand.maximum)
    return static_cast<std::int32_t>(value);
  out_of_range(value, number, span, operand, command);
  return std::nullopt;
}

void Assembler::wrong_unit(const Value& number, Span span, const MacroOperand& operand,
                           std::string_view command) {
  if (number.unit == Unit::Unknown) {
    const auto word = text(number.span);
    const bool hex = word.ends_with('h') || word.ends_with('H');
    report(rules::WrongUnit, span, fmt::format("`{}` is not a number", word),
           hex ? fmt::format("write hexadecimal as `0x{}`", word.substr(0, word.size() - 1))
               : "units are `ms`, `s` and `deg`, with at most three decimals before them");
    return;
  }
  report(rules::WrongUnit, span,
         fmt::format("`{}` of `{}` does not take the unit `{}`", operand.name, command,
                     unit_word(number.unit)),
         fmt::format("it is {}", range_of(operand)));
}

std::string Assembler::waits_for(std::int64_t ms) {
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

void Assembler::out_of_range(std::int64_t value, const Value& number, Span span,
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
  auto& d =
      report(rules::OutOfRange, span,
             fmt::format("`{}` of `{}` is {}, found {}", operand.name, command, range_of(operand),
                         is_exact ? std::to_string(value) : fmt::format("`{}`", text(span))),
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

std::string Assembler::read_text(const Value& value) {
  if (value.kind != Value::Kind::Text) {
    report(rules::OutOfRange, value.span, "a comment needs text in quotes",
           fmt::format("write `comment \"{}\"`", text(value.span)));
    return {};
  }
  const auto quoted = text(value.span);
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
