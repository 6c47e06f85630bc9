#include "assembler/names.h"

#include "assembler/text/rules.h"
#include "base/text/suggest.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::assembler {

namespace {

void set_flags(AssembledMacro& defined, int flags) {
  defined.flags = static_cast<std::uint8_t>(flags);
  if (spec::has_flag(*defined.flags, spec::MacroFlag::ExtFlags) && !defined.extended_flags)
    defined.extended_flags = 0;
}

} // namespace

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
    findings_
        .add(rules::DuplicateName, span,
             fmt::format("`{}` is defined twice", program_.text_of(span)))
        .notes.push_back({old->second.span, "first defined here"});
}

void Names::define_constant(const Statement& statement) {
  const auto values = program_.values_of(statement);
  if (values.size() != 1 || values[0].name.size() == 0) {
    findings_.add(rules::Syntax, statement.span, "`.const` takes a name and a value",
                  "write `.const NAME = 100`");
    return;
  }
  const auto& value = values[0];
  Name name;
  name.value = value;
  if (value.kind == Value::Kind::Word)
    if (const auto* other = find(program_.text_of(value.span));
        other != nullptr && other->kind == Name::Kind::Constant)
      name.value = other->value;
  define(value.name, name);
}

void Names::define_macro(const Statement& statement) {
  AssembledMacro defined;
  const auto values = program_.values_of(statement);
  if (values.empty() || values[0].kind != Value::Kind::Word || values[0].name.size() != 0) {
    findings_.add(rules::Header, statement.head, "`.macro` needs a name",
                  "write `.macro NAME id=40 flags=motor_control`");
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
  if (attribute == "id")
    return read_id(defined, value);
  if (attribute == "flags")
    return read_flag(defined, value);
  if (attribute == "ext") {
    if (const auto byte = header_byte(value, 0, "extended flags must be"))
      defined.extended_flags = byte;
    return;
  }
  constexpr std::string_view attributes[] = {"id", "flags", "ext"};
  findings_.add(rules::Header, value.name.size() != 0 ? value.name : value.span,
                attribute.empty() ? "unexpected second name"
                                  : fmt::format("`.macro` has no `{}=`", attribute),
                did_you_mean(attribute, attributes, "use `id=`, `flags=` or `ext=`"));
}

std::optional<std::uint8_t> Names::header_byte(const Value& value, int minimum,
                                               std::string_view what) {
  const auto* found = number(value);
  if (found != nullptr && found->is_known && found->unit == nullptr &&
      found->thousandths % whole == 0 && found->thousandths >= minimum * whole &&
      found->thousandths <= UINT8_MAX * whole)
    return static_cast<std::uint8_t>(found->thousandths / whole);
  findings_.add(rules::Header, value.span,
                fmt::format("{} {} to {}, found `{}`", what, minimum, UINT8_MAX,
                            program_.text_of(value.span)));
  return std::nullopt;
}

void Names::read_id(AssembledMacro& defined, const Value& value) {
  const auto id = header_byte(value, spec::macro_id_none, "an id must be");
  if (!id)
    return offer_id(findings_.all().back(), value.span, spec::macro_id_user_first);
  const auto kind = spec::macro_id_kind(*id);
  if (kind == spec::MacroIdKind::None)
    offer_id(findings_.add(rules::Header, value.span, "id 0 means that no macro is running",
                           fmt::format("write an id from {} to {}", spec::macro_id_user_first,
                                       spec::macro_id_user_last)),
             value.span, spec::macro_id_user_first);
  if (kind == spec::MacroIdKind::System) {
    auto& d = findings_.add(rules::Header, value.span,
                            fmt::format("ids {} to {} are reserved for the ball's own macros",
                                        spec::macro_id_system_first, spec::macro_id_system_last),
                            fmt::format("write an id from {} to {}", spec::macro_id_user_first,
                                        spec::macro_id_user_last));
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
  d.help = fmt::format("write `id={}`", free);
  d.fix = Fix{d.help, {{span, std::to_string(free)}}, Safety::Unsafe};
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
      findings_.add(rules::Header, value.span, fmt::format("`{}` is not a macro flag", word),
                    did_you_mean(word, words, fmt::format("the flags are {}", all)));
      return;
    }
  }
  if (const auto byte = header_byte(value, 0, "flags must be"))
    set_flags(defined, old | *byte);
}

void Names::check_id_is_free(const AssembledMacro& defined) {
  if (!defined.id)
    return;
  for (const auto& other : macros_)
    if (other.id == defined.id) {
      auto& d = findings_.add(
          rules::DuplicateId, defined.span,
          fmt::format("`{}` and `{}` have the same id {}", other.name, defined.name, *defined.id));
      d.notes.push_back({other.span, fmt::format("`{}` is here", other.name)});
      offer_id(d, id_span_, *defined.id);
      return;
    }
}

} // namespace orb::assembler
