#include "assembler/constants.h"

#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/fixes.h"
#include "base/meant.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::assembler {

namespace {

/// The fields after the name in a `.macro` line: `id=40`.
namespace header {
constexpr Slot id = slot::whole("N", texts::Id, spec::macro_id_none, UINT8_MAX).after("id");
constexpr Slot flags = slot::whole("FLAG,…", texts::Flags, 0, UINT8_MAX).after("flags");
constexpr Slot ext = slot::whole("N", texts::ExtendedFlags, 0, UINT8_MAX).after("ext");
} // namespace header

void set_flags(AssembledMacro& defined, int flags) {
  defined.flags = static_cast<std::uint8_t>(flags);
  if (spec::has_flag(*defined.flags, spec::MacroFlag::ExtFlags) && !defined.extended_flags)
    defined.extended_flags = 0;
}

} // namespace

void add_no_number(Findings& findings, const Program& program, Span span) {
  const auto word = program.text_of(span);
  const bool hex = word.ends_with('h') || word.ends_with('H');
  findings.add(rules::WrongUnit, span, texts::NotANumber(word),
               hex ? texts::WriteHexadecimal(fmt::format("0x{}", word.substr(0, word.size() - 1)))
                   : texts::UnitsAre());
}

Names::Names(const Program& program, Findings& findings) : program_(program), findings_(findings) {
  for (const auto& statement : program.statements) {
    if (statement.kind == Statement::Kind::Const)
      define_constant(statement);
    else if (statement.kind == Statement::Kind::Macro)
      define_macro(statement);
  }
}

const Name* Names::find(std::string_view word) const {
  const auto found = names_.find(word);
  return found == names_.end() ? nullptr : &found->second;
}

const Value* Names::number(const Value& value) const {
  if (value.kind == Value::Kind::Number)
    return &value;
  if (value.kind == Value::Kind::Text)
    return nullptr;
  const auto* name = find(program_.text_of(value.span));
  return name != nullptr && name->kind == Name::Kind::Constant &&
                 name->value.kind == Value::Kind::Number
             ? &name->value
             : nullptr;
}

void Names::define(Span span, Name name) {
  name.span = span;
  const auto [old, is_new] = names_.emplace(program_.text_of(span), name);
  if (!is_new)
    findings_.add(rules::DuplicateName, span, texts::DefinedTwice(program_.text_of(span)))
        .notes.push_back({old->second.span, texts::FirstDefined()});
}

void Names::define_constant(const Statement& statement) {
  const auto values = program_.values_of(statement);
  if (values.size() != 1 || values[0].name.size() == 0) {
    findings_.add(rules::Syntax, statement.span, texts::NameAndValue(".const"),
                  texts::Write(".const NAME = 100"));
    return;
  }
  const auto& value = values[0];
  Name name;
  name.value = value;
  if (value.kind == Value::Kind::Word)
    if (const auto* other = find(program_.text_of(value.span));
        other != nullptr && other->kind == Name::Kind::Constant)
      name.value = other->value;
  if (value.kind == Value::Kind::Number && !value.is_known)
    add_no_number(findings_, program_, value.span);
  define(value.name, name);
}

void Names::define_macro(const Statement& statement) {
  AssembledMacro defined;
  const auto values = program_.values_of(statement);
  if (values.empty() || values[0].kind != Value::Kind::Word || values[0].name.size() != 0) {
    findings_.add(rules::Header, statement.head, texts::MacroNeedsName(),
                  texts::Write(".macro NAME id=40 flags=motor_control"));
    defined.span = statement.head;
    macros_.push_back(std::move(defined));
    return;
  }
  defined.name = program_.text_of(values[0].span);
  defined.span = values[0].span;
  Name name;
  name.kind = Name::Kind::Macro;
  name.macro = macros_.size();
  define(values[0].span, name);
  std::string_view attribute;
  for (const auto& value : values.subspan(1)) {
    if (value.name.size() != 0)
      attribute = program_.text_of(value.name);
    read_attribute(defined, attribute, value);
  }
  if (defined.extended_flags)
    set_flags(defined, defined.flags.value_or(spec::macro_default_flags) |
                           static_cast<int>(spec::MacroFlag::ExtFlags));
  check_id_is_free(defined);
  macros_.push_back(std::move(defined));
}

void Names::read_attribute(AssembledMacro& defined, std::string_view attribute,
                           const Value& value) {
  if (attribute == header::id.before)
    return read_id(defined, value);
  if (attribute == header::flags.before)
    return read_flag(defined, value);
  if (attribute == header::ext.before) {
    if (const auto byte = header_byte(value, header::ext))
      defined.extended_flags = byte;
    return;
  }
  constexpr std::array words{header::id.before, header::flags.before, header::ext.before};
  findings_.add(rules::Header, value.name.size() != 0 ? value.name : value.span,
                attribute.empty() ? texts::SecondName() : texts::NoAttribute(".macro", attribute),
                meant_or(attribute, words, texts::AttributesAre()));
}

std::optional<std::uint8_t> Names::header_byte(const Value& value, const Slot& slot) {
  const auto* found = number(value);
  if (found != nullptr && found->is_known && found->unit == nullptr &&
      found->thousandths % whole == 0 && found->thousandths >= slot.least * whole &&
      found->thousandths <= slot.most * whole)
    return static_cast<std::uint8_t>(found->thousandths / whole);
  findings_.add(rules::Header, value.span,
                texts::Found(must_be(slot), program_.text_of(value.span)));
  return std::nullopt;
}

void Names::read_id(AssembledMacro& defined, const Value& value) {
  const auto id = header_byte(value, header::id);
  if (!id)
    return offer_id(findings_.all().back(), value.span, spec::macro_id_user_first);
  const auto kind = spec::macro_id_kind(*id);
  if (kind == spec::MacroIdKind::None)
    offer_id(findings_.add(rules::Header, value.span, texts::IdOfNone(),
                           texts::IdRange(spec::macro_id_user_first, spec::macro_id_user_last)),
             value.span, spec::macro_id_user_first);
  if (kind == spec::MacroIdKind::System) {
    auto& d =
        findings_.add(rules::Header, value.span,
                      texts::IdsOfSystem(spec::macro_id_system_first, spec::macro_id_system_last),
                      texts::IdRange(spec::macro_id_user_first, spec::macro_id_user_last));
    d.severity = Severity::Warning;
    offer_id(d, value.span, spec::macro_id_user_first);
  }
  id_span_ = value.span;
  defined.id = id;
}

void Names::offer_id(Diagnostic& d, Span span, std::uint8_t first) const {
  const auto is_taken = [&](std::uint8_t free) {
    return std::any_of(macros_.begin(), macros_.end(),
                       [&](const AssembledMacro& macro) { return macro.id == free; });
  };
  auto free = first;
  while (free < spec::macro_id_user_last && is_taken(free))
    ++free;
  if (is_taken(free))
    return;
  d.help = texts::Write(fmt::format("id={}", free));
  d.fix = single_fix(d.help, span, std::to_string(free), Safety::Unsafe);
}

void Names::read_flag(AssembledMacro& defined, const Value& value) {
  defined.flags_span = value.span;
  const auto old = defined.flags.value_or(0);
  if (value.kind == Value::Kind::Word) {
    const auto word = program_.text_of(value.span);
    if (word == "none") {
      defined.flags = old;
      return;
    }
    if (const auto* flag = spec::find_macro_flag(word)) {
      set_flags(defined, old | flag->bit);
      return;
    }
    if (find(word) == nullptr) {
      std::array<std::string_view, std::size(spec::macro_flags)> words;
      std::string all;
      for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = spec::macro_flags[i].word;
        all += fmt::format("{}`{}`", i == 0 ? "" : ", ", words[i]);
      }
      findings_.add(rules::Header, value.span, texts::NotAFlag(word),
                    meant_or(word, words, texts::FlagsAre(all)));
      return;
    }
  }
  if (const auto byte = header_byte(value, header::flags))
    set_flags(defined, old | *byte);
}

void Names::check_id_is_free(const AssembledMacro& defined) {
  if (!defined.id)
    return;
  for (const auto& other : macros_)
    if (other.id == defined.id) {
      auto& d = findings_.add(rules::DuplicateId, defined.span,
                              texts::SameId(other.name, defined.name, *defined.id));
      d.notes.push_back({other.span, texts::IsHere(other.name)});
      offer_id(d, id_span_, *defined.id);
      return;
    }
}

} // namespace orb::assembler
