#include "assembler/assemble.h"

#include "assembler/parse.h"
#include "assembler/rules.h"
#include "base/suggest.h"
#include "base/text.h"
#include "base/utf8.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace orb::assembler {
namespace {

using spec::MacroCommand;
using spec::MacroOperand;
using spec::MacroOperandKind;
using spec::MacroUnit;
using Origin = PlacedCommand::Origin;

struct Name {
  enum class Kind : std::uint8_t { Constant, Macro };
  Kind kind = Kind::Constant;
  Value value;           ///< of a constant
  std::size_t macro = 0; ///< of a macro
  Span span;
};

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

class Assembler {
public:
  Assembler(const Source& source, Folding folding)
      : source_(source), folding_(folding), program_(parse(source.text())) {
    assembly_.diagnostics = std::move(program_.diagnostics);
  }

  Assembly run() {
    collect_names();
    if (assembly_.macros.empty())
      begin_unnamed();
    for (const auto& statement : program_.statements)
      add(statement);
    end_macro();
    if (program_.statements.size() == constants_ && assembly_.diagnostics.empty())
      report(rules::EmptyFile, {0, 0}, "the file holds no macro command",
             "write one, such as `marker 20`");
    sort_by_place(assembly_.diagnostics);
    return std::move(assembly_);
  }

private:
  std::string_view text(Span span) const { return source_.text().substr(span.begin, span.size()); }

  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {}) {
    assembly_.diagnostics.push_back(finding(rule, span, std::move(message), std::move(help)));
    return assembly_.diagnostics.back();
  }

  AssembledMacro& macro() { return assembly_.macros[current_]; }

  const Value* values(const Statement& statement) const {
    return program_.values.data() + statement.first;
  }

  // Names.

  void collect_names() {
    for (const auto& statement : program_.statements) {
      if (statement.kind == Statement::Kind::Const)
        define_constant(statement);
      else if (statement.kind == Statement::Kind::Macro)
        define_macro(statement);
    }
  }

  void define(Span span, Name name) {
    name.span = span;
    const auto [old, is_new] = names_.emplace(text(span), name);
    if (!is_new)
      report(rules::DuplicateName, span, fmt::format("`{}` is defined twice", text(span)))
          .notes.push_back({old->second.span, "first here"});
  }

  void define_constant(const Statement& statement) {
    ++constants_;
    const auto* value = values(statement);
    if (statement.count != 1 || value->name.size() == 0) {
      report(rules::Syntax, statement.span, "`.const` takes a name and a value",
             "write `.const NAME = 100`");
      return;
    }
    Name name;
    name.value = *value;
    if (value->kind == Value::Kind::Word)
      if (const auto* other = find_name(text(value->span));
          other != nullptr && other->kind == Name::Kind::Constant)
        name.value = other->value;
    define(value->name, name);
  }

  void define_macro(const Statement& statement) {
    AssembledMacro defined;
    const auto* value = values(statement);
    if (statement.count == 0 || value->kind != Value::Kind::Word || value->name.size() != 0) {
      report(rules::Header, statement.head, "`.macro` takes a name",
             "write `.macro NAME id=40 flags=motor_control`");
      defined.span = statement.head;
      assembly_.macros.push_back(std::move(defined));
      return;
    }
    defined.name = text(value->span);
    defined.span = value->span;
    Name name;
    name.kind = Name::Kind::Macro;
    name.macro = assembly_.macros.size();
    define(value->span, name);
    std::string_view attribute;
    for (const auto* at = value + 1; at != value + statement.count; ++at) {
      if (at->name.size() != 0)
        attribute = text(at->name);
      read_attribute(defined, attribute, *at);
    }
    if (defined.extended_flags)
      set_flags(defined, defined.flags.value_or(spec::macro_default_flags) |
                             static_cast<int>(spec::MacroFlag::ExtFlags));
    check_id_is_free(defined);
    assembly_.macros.push_back(std::move(defined));
  }

  void read_attribute(AssembledMacro& defined, std::string_view attribute, const Value& value) {
    if (attribute == "id")
      return read_id(defined, value);
    if (attribute == "flags")
      return read_flag(defined, value);
    if (attribute == "ext") {
      if (const auto byte = header_byte(value, 0, "extended flags are"))
        defined.extended_flags = byte;
      return;
    }
    constexpr std::string_view attributes[] = {"id", "flags", "ext"};
    report(rules::Header, value.name.size() != 0 ? value.name : value.span,
           attribute.empty() ? "a macro has one name"
                             : fmt::format("`.macro` has no `{}=`", attribute),
           did_you_mean(attribute, attributes, "there are `id=`, `flags=` and `ext=`"));
  }

  std::optional<std::uint8_t> header_byte(const Value& value, int minimum, std::string_view what) {
    const auto* number = &value;
    if (value.kind == Value::Kind::Word)
      if (const auto* name = find_name(text(value.span));
          name != nullptr && name->kind == Name::Kind::Constant)
        number = &name->value;
    if (number->kind == Value::Kind::Number && number->unit == Unit::None &&
        number->thousandths % whole == 0 && number->thousandths >= minimum * whole &&
        number->thousandths <= UINT8_MAX * whole)
      return static_cast<std::uint8_t>(number->thousandths / whole);
    report(rules::Header, value.span,
           fmt::format("{} {} to {}, found `{}`", what, minimum, UINT8_MAX, text(value.span)));
    return std::nullopt;
  }

  void read_id(AssembledMacro& defined, const Value& value) {
    const auto id = header_byte(value, spec::macro_id_none, "an id is");
    if (!id)
      return;
    const auto kind = spec::macro_id_kind(*id);
    if (kind == spec::MacroIdKind::None)
      report(rules::Header, value.span, "id 0 means that no macro is running",
             fmt::format("write an id from {} to {}", spec::macro_id_user_first,
                         spec::macro_id_user_last));
    if (kind == spec::MacroIdKind::System)
      report(rules::Header, value.span,
             fmt::format("ids {} to {} are the ball's own macros", spec::macro_id_system_first,
                         spec::macro_id_system_last),
             fmt::format("write an id from {} to {}", spec::macro_id_user_first,
                         spec::macro_id_user_last))
          .severity = Severity::Warning;
    defined.id = id;
  }

  void read_flag(AssembledMacro& defined, const Value& value) {
    defined.flags_span = value.span;
    const auto old = defined.flags.value_or(0);
    if (value.kind == Value::Kind::Word) {
      const auto word = text(value.span);
      if (word == "none") {
        defined.flags = old;
        return;
      }
      if (const auto* flag = spec::find_macro_flag(word)) {
        set_flags(defined, old | flag->bit);
        return;
      }
      if (find_name(word) == nullptr) {
        std::array<std::string_view, std::size(spec::macro_flags)> words;
        std::string all;
        for (std::size_t i = 0; i < words.size(); ++i) {
          words[i] = spec::macro_flags[i].word;
          all += fmt::format("{}`{}`", i == 0 ? "" : ", ", words[i]);
        }
        report(rules::Header, value.span, fmt::format("`{}` is not a macro flag", word),
               did_you_mean(word, words, fmt::format("there are {}", all)));
        return;
      }
    }
    if (const auto byte = header_byte(value, 0, "flags are"))
      set_flags(defined, old | *byte);
  }

  static void set_flags(AssembledMacro& defined, int flags) {
    defined.flags = static_cast<std::uint8_t>(flags);
    if (spec::has_flag(*defined.flags, spec::MacroFlag::ExtFlags) && !defined.extended_flags)
      defined.extended_flags = 0;
  }

  void check_id_is_free(const AssembledMacro& defined) {
    if (!defined.id)
      return;
    for (const auto& other : assembly_.macros)
      if (other.id == defined.id) {
        report(
            rules::DuplicateId, defined.span,
            fmt::format("`{}` and `{}` have the same id {}", other.name, defined.name, *defined.id))
            .notes.push_back({other.span, fmt::format("`{}` is here", other.name)});
        return;
      }
  }

  const Name* find_name(std::string_view word) const {
    const auto found = names_.find(word);
    return found == names_.end() ? nullptr : &found->second;
  }

  // Macros and their commands.

  void begin_unnamed() {
    assembly_.macros.emplace_back();
    inside_ = true;
    reserve();
  }

  /// Room for what the rest of the file may hold.
  void reserve() {
    macro().commands.reserve(program_.statements.size() + 1);
    macro().body.reserve(program_.statements.size() * 5);
  }

  void add(const Statement& statement) {
    switch (statement.kind) {
    case Statement::Kind::Const: return;
    case Statement::Kind::Macro:
      if (inside_) {
        end_macro();
        ++current_;
      }
      inside_ = true;
      if (assembly_.macros.size() == 1)
        reserve();
      return;
    case Statement::Kind::Command:
    case Statement::Kind::Raw:
    case Statement::Kind::NoEnd: break;
    }
    if (!inside_) {
      if (!outside_reported_)
        report(rules::OutsideMacro, statement.span, "this stands before the first `.macro` line",
               "move it below a `.macro` line, or write one above it");
      outside_reported_ = true;
      return;
    }
    if (statement.kind == Statement::Kind::NoEnd)
      no_end_ = true;
    else if (statement.kind == Statement::Kind::Raw)
      add_raw(statement);
    else
      add_command(statement);
  }

  void end_macro() {
    if (!inside_)
      return;
    auto& ended = macro();
    if (!ended.has_end && !no_end_) {
      place(spec::info(MacroCommand::End), {}, {}, Origin::Supplied, {}, {});
      ended.has_end = true;
    }
    no_end_ = false;
    after_end_reported_ = false;
  }

  void add_raw(const Statement& statement) {
    auto& out = macro();
    const auto begin = static_cast<std::uint32_t>(out.body.size());
    for (const auto* value = values(statement); value != values(statement) + statement.count;
         ++value) {
      static constexpr auto byte =
          spec::macro_detail::number("byte", MacroUnit::None, 1, 0, UINT8_MAX);
      if (value->name.size() != 0)
        report(rules::UnknownOperand, value->name, "`.raw` takes bytes, not names");
      else if (const auto number = resolve(*value, byte, ".raw"))
        out.body.push_back(static_cast<std::uint8_t>(*number));
    }
    const ByteView raw = ByteView(out.body).subspan(begin);
    const auto listing = protocol::decode_macro_body(raw);
    if (listing.error) {
      PlacedCommand placed;
      placed.origin = Origin::Raw;
      placed.span = statement.span;
      placed.offset = begin;
      placed.size = static_cast<std::uint32_t>(raw.size());
      out.commands.push_back(placed);
      return;
    }
    for (const auto& step : listing.steps)
      out.commands.push_back({step.info, Origin::Raw, statement.span, statement.span,
                              begin + step.offset, step.size, step.value});
    out.has_end = listing.has_end;
  }

  void add_command(const Statement& statement) {
    auto& out = macro();
    if (out.has_end && out.id != spec::macro_id_stream) {
      if (!after_end_reported_)
        report(rules::AfterEnd, statement.span, "this comes after `end`",
               "remove `end`, or begin another macro with `.macro`");
      after_end_reported_ = true;
      return;
    }
    const spec::MacroCommandInfo* info = statement.info;
    std::array<const Value*, spec::macro_max_operands> bound{};
    std::array<std::int32_t, spec::macro_max_operands> value{};
    bool good = bind(statement, *info, bound);
    if (good) {
      if (info->command == MacroCommand::Roll && bound[2] != nullptr)
        info = roll_for(*bound[2]);
      for (std::size_t i = 0; i < info->operand_count; ++i) {
        if (bound[i] == nullptr || info->operand[i].kind == MacroOperandKind::Text)
          continue;
        const auto number = resolve(*bound[i], info->operand[i], info->mnemonic);
        good = good && number.has_value();
        value[i] = number.value_or(0);
      }
    }
    const auto operand = statement.count > 0 ? values(statement)->span : Span{};
    if (info->variable_length) {
      const auto comment = good ? read_text(*bound[0]) : std::string();
      place(*info, statement.span, operand, good ? Origin::Written : Origin::Broken, value,
            comment);
      out.has_end = false;
      return;
    }
    if (good && folding_ == Folding::Fold && info->command == MacroCommand::Delay && fold(value[0]))
      return;
    place(*info, statement.span, operand, good ? Origin::Written : Origin::Broken, value, {});
    out.has_end = info->command == MacroCommand::End;
  }

  void place(const spec::MacroCommandInfo& info, Span span, Span operand, Origin origin,
             const std::array<std::int32_t, spec::macro_max_operands>& value,
             std::string_view comment) {
    auto& out = macro();
    PlacedCommand placed{&info, origin, span, operand, static_cast<std::uint32_t>(out.body.size()),
                         0,     value};
    protocol::append_macro_command(out.body, info.command,
                                   std::span(value).first(info.operand_count), comment);
    placed.size = static_cast<std::uint32_t>(out.body.size()) - placed.offset;
    if (info.variable_length)
      placed.value[0] = static_cast<std::int32_t>(comment.size());
    out.commands.push_back(placed);
  }

  /// Which operand each value is for. False, with a finding, where that does not work out.
  bool bind(const Statement& statement, const spec::MacroCommandInfo& info,
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
        report(rules::OperandCount, value->span, "an operand without a name follows a named one",
               fmt::format("`{}` takes {}", info.mnemonic, operand_list(info)));
        return false;
      } else if (position == info.operand_count) {
        report(rules::OperandCount, value->span,
               info.operand_count == 0
                   ? fmt::format("`{}` takes no operand", info.mnemonic)
                   : fmt::format("`{}` takes {}, found {}", info.mnemonic,
                                 plural(info.operand_count, "operand"), statement.count),
               info.operand_count == 0 ? std::string()
                                       : fmt::format("they are {}", operand_list(info)));
        return false;
      }
      if (bound[i] != nullptr) {
        report(rules::OperandCount, value->span,
               fmt::format("`{}` is given twice", info.operand[i].name));
        return false;
      }
      bound[i] = value;
      ++position;
    }
    for (std::size_t i = 0; i < info.operand_count; ++i)
      if (bound[i] == nullptr && info.operand[i].kind != MacroOperandKind::Delay) {
        report(rules::OperandCount, statement.span,
               fmt::format("`{}` needs its operand `{}`", info.mnemonic, info.operand[i].name),
               fmt::format("it takes {}, as in `{}`", operand_list(info), info.example));
        return false;
      }
    return true;
  }

  bool unknown_operand(const spec::MacroCommandInfo& info, Span span) {
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

  /// A delay that does not fit into a byte makes a roll a roll2.
  const spec::MacroCommandInfo* roll_for(const Value& delay) {
    const auto& roll = spec::info(MacroCommand::Roll);
    const auto& roll2 = spec::info(MacroCommand::Roll2);
    const auto* number = constant(delay);
    const auto per = number == nullptr ? 0 : scale(number->unit, roll2.operand[2].unit);
    return per > 0 && number->thousandths / whole * per / whole > roll.operand[2].maximum ? &roll2
                                                                                          : &roll;
  }

  /// The number that a value stands for; null where it is none.
  const Value* constant(const Value& value) const {
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

  /// The value of an operand in the operand's own unit, or nothing and a finding.
  std::optional<std::int32_t> resolve(const Value& value, const MacroOperand& operand,
                                      std::string_view command) {
    if (operand.kind == MacroOperandKind::Text)
      return std::nullopt;
    if (value.kind == Value::Kind::Number)
      return to_number(value, value.span, operand, command);
    if (value.kind == Value::Kind::Text) {
      report(rules::OutOfRange, value.span,
             fmt::format("`{}` of `{}` is a number, found text", operand.name, command));
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

  std::optional<std::int32_t> macro_id(Span span, const Name& name, const MacroOperand& operand) {
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
    report(rules::UnknownName, span, fmt::format("`{}` has no id to go to", text(span)),
           fmt::format("write `.macro {} id={}`", text(span), spec::macro_id_user_first))
        .notes.push_back({target.span, "defined here"});
    return std::nullopt;
  }

  std::optional<std::int32_t> unknown_name(Span span, const MacroOperand& operand,
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
        fmt::format("`{}` means nothing as `{}` of `{}`", text(span), operand.name, command), help);
    if (meant)
      diagnostic.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
    return std::nullopt;
  }

  std::optional<std::int32_t> to_number(const Value& number, Span span, const MacroOperand& operand,
                                        std::string_view command) {
    const auto per = scale(number.unit, operand.unit);
    if (number.unit == Unit::Unknown || per == 0) {
      wrong_unit(number, span, operand, command);
      return std::nullopt;
    }
    // Thousandths of a number times thousandths of the own unit: bounded far below 2^63.
    const auto millionths = number.thousandths * per;
    if (millionths % (whole * whole) != 0) {
      report(
          rules::OutOfRange, span,
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

  void wrong_unit(const Value& number, Span span, const MacroOperand& operand,
                  std::string_view command) {
    if (number.unit == Unit::Unknown) {
      const auto word = text(number.span);
      const bool hex = word.ends_with('h') || word.ends_with('H');
      report(rules::WrongUnit, span, fmt::format("`{}` is not a number", word),
             hex ? fmt::format("hex is written `0x{}`", word.substr(0, word.size() - 1))
                 : "units are `ms`, `s` and `deg`, with at most three decimals before them");
      return;
    }
    report(
        rules::WrongUnit, span,
        fmt::format("`{}` of `{}` has no unit `{}`", operand.name, command, unit_word(number.unit)),
        fmt::format("it is {}", range_of(operand)));
  }

  /// The lines that wait as long; empty for what would be a page of them.
  static std::string waits_for(std::int64_t ms) {
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

  /// `span` is where the number is used: it, or the name of a constant that holds it.
  void out_of_range(std::int64_t value, const Value& number, Span span, const MacroOperand& operand,
                    std::string_view command) {
    const bool is_exact = std::abs(number.thousandths) < largest_number * whole;
    std::string help;
    if (operand.kind == MacroOperandKind::Delay)
      help = waits_for(value);
    else if (is_exact && operand.unit == MacroUnit::Degrees && !operand.is_signed)
      help = fmt::format("{} deg is the same way", same_way(value, operand.maximum + 1));
    else if (operand.word_count > 0)
      for (std::size_t i = 0; i < operand.word_count; ++i)
        help += fmt::format("{}`{}`", i == 0 ? "it is one of " : ", ", operand.words[i].word);
    report(rules::OutOfRange, span,
           fmt::format("`{}` of `{}` is {}, found {}", operand.name, command, range_of(operand),
                       is_exact ? std::to_string(value) : fmt::format("`{}`", text(span))),
           help);
  }

  std::string read_text(const Value& value) {
    if (value.kind != Value::Kind::Text) {
      report(rules::OutOfRange, value.span, "a comment takes text in quotes",
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

  /// Takes a delay into the command before it. False where that has no delay of its own, or no
  /// room.
  bool fold(std::int32_t time_ms) {
    auto& out = macro();
    if (out.commands.empty())
      return false;
    auto& last = out.commands.back();
    if (last.origin != Origin::Written || last.info->operand_count == 0)
      return false;
    const auto delay = last.info->operand_count - 1U;
    if (last.info->operand[delay].kind != MacroOperandKind::Delay)
      return false;
    const auto total = last.value[delay] + time_ms;
    const auto* info = last.info;
    if (total > info->operand[delay].maximum && info->command == MacroCommand::Roll)
      info = &spec::info(MacroCommand::Roll2);
    if (total > info->operand[delay].maximum)
      return false;
    auto folded = last;
    folded.value[delay] = total;
    out.commands.pop_back();
    out.body.resize(folded.offset);
    place(*info, folded.span, folded.operand, Origin::Written, folded.value, {});
    return true;
  }

  const Source& source_;
  Folding folding_;
  Program program_;
  Assembly assembly_;
  std::unordered_map<std::string_view, Name> names_;
  std::size_t constants_ = 0;
  std::size_t current_ = 0;
  bool inside_ = false;
  bool no_end_ = false;
  bool outside_reported_ = false;
  bool after_end_reported_ = false;
};

std::optional<Diagnostic> unreadable(const Source& source) {
  const auto text = source.text();
  if (text.empty())
    return finding(rules::EmptyFile, {0, 0}, "the file is empty",
                   "write a command, such as `marker 20`");
  if (text.size() > largest_source)
    return finding(
        rules::SourceTooLarge, {0, 0},
        fmt::format("the file has {} bytes; the limit is {}", text.size(), largest_source));
  // One pass without branches first: nearly every file is text.
  bool any = false;
  for (const char c : text)
    any |= is_binary_byte[static_cast<unsigned char>(c)];
  if (!any)
    return std::nullopt;
  const auto* const binary = std::find_if(text.data(), text.data() + text.size(), [](char c) {
    return is_binary_byte[static_cast<unsigned char>(c)];
  });
  const auto at = static_cast<std::uint32_t>(binary - text.data());
  return finding(
      rules::BinaryFile, {at, at + 1},
      fmt::format("the file is not text: byte {:02X}h", static_cast<unsigned char>(*binary)),
      "`orb disasm` reads the bytes of a macro");
}

} // namespace

protocol::MacroImage AssembledMacro::image() const {
  return {id.value_or(spec::macro_id_temporary), flags.value_or(spec::macro_default_flags),
          extended_flags, body};
}

std::size_t AssembledMacro::framed_size() const {
  return 2 + (extended_flags ? 1 : 0) + body.size();
}

bool Assembly::has_errors() const {
  return any_error(diagnostics);
}

Assembly assemble(const Source& source, Folding folding) {
  if (auto problem = unreadable(source)) {
    Assembly assembly;
    assembly.diagnostics.push_back(std::move(*problem));
    return assembly;
  }
  return Assembler(source, folding).run();
}

} // namespace orb::assembler
