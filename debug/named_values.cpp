// Looks up the names of a program in the ball: variables, elements and constants.

#include "debug/debugger.h"

#include "base/text/suggest.h"
#include "base/text/text.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace orb::debug {
namespace {

constexpr std::string_view time_word = "time";
constexpr std::string_view letter_words = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view array_word = "Z"; ///< in programs with line numbers

/// The index of a letter: A is 0, Y is 24; nothing for other names.
std::optional<std::size_t> letter_of(std::string_view name) {
  if (name.size() != 1)
    return std::nullopt;
  const auto letter = static_cast<std::size_t>(std::toupper(static_cast<unsigned char>(name[0]))) -
                      static_cast<std::size_t>('A');
  return letter < letters ? std::optional(letter) : std::nullopt;
}

/// The symbol of that name in a structured program for which `is` is true; null if there is none.
template <class Is>
const structured::Symbol* symbol_called(const structured::Compiled& compiled, std::string_view name,
                                        Is is) {
  for (const auto& symbol : compiled.names.symbols)
    if (is(symbol) && equal_words(compiled.program.name(symbol.name), name))
      return &symbol;
  return nullptr;
}

auto is_a(structured::SymbolKind kind) {
  return [kind](const structured::Symbol& symbol) { return symbol.kind == kind; };
}

} // namespace

tl::expected<Expression, std::string> Debugger::expression(std::string_view text) const {
  auto parsed = Expression::parse(text);
  if (!parsed)
    return parsed;
  const auto known = names();
  for (const auto name : parsed->names())
    if (std::none_of(known.begin(), known.end(),
                     [&](std::string_view one) { return equal_words(one, name); }))
      return tl::unexpected(
          fmt::format("there is no variable `{}`{}", name,
                      closest(name, known) ? "; " + did_you_mean(name, known, "") : ""));
  return parsed;
}

std::vector<std::string_view> Debugger::names() const {
  std::vector<std::string_view> all{time_word};
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto& compiled = *input->program->compiled;
    for (const auto& symbol : compiled.names.symbols)
      if (!is_a(structured::SymbolKind::Sub)(symbol) &&
          !is_a(structured::SymbolKind::Function)(symbol))
        all.push_back(compiled.program.name(symbol.name));
  } else if (input != nullptr) {
    for (const auto& letter : letter_words)
      all.emplace_back(&letter, 1);
  }
  return all;
}

std::optional<std::size_t> Debugger::register_of(std::string_view name) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return std::nullopt;
  const auto& compiled = input->program->compiled;
  if (!compiled)
    return letter_of(name);
  const auto* line = program_line();
  for (std::size_t i = 0; line != nullptr && i < letters; ++i)
    if (line->symbols[i] != structured::none &&
        equal_words(compiled->program.name(compiled->names.symbols[line->symbols[i]].name), name))
      return i;
  return std::nullopt;
}

std::string Debugger::missing(std::string_view name) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto any = [](const structured::Symbol&) { return true; };
    if (symbol_called(*input->program->compiled, name, any) != nullptr)
      return fmt::format("the robot does not store `{}` here: it is no longer needed, or the "
                         "compiler knew its value",
                         name);
  }
  return fmt::format("unknown variable `{}`", name);
}

std::optional<std::int32_t> Debugger::variable(std::string_view name) const {
  if (const auto found = register_of(name))
    return timeline_->ball().machine().variable(*found);
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input != nullptr && input->program->compiled) {
    const auto constant = is_a(structured::SymbolKind::Constant);
    if (const auto* found = symbol_called(*input->program->compiled, name, constant))
      return found->value;
  }
  if (equal_words(name, time_word))
    return static_cast<std::int32_t>((moving_at_ ? *moving_at_ : timeline_->time()) /
                                     std::chrono::milliseconds{1});
  if (input != nullptr && !input->program->compiled && equal_words(name, array_word))
    return element(name, timeline_->ball().machine().variable(bytecode::index_variable));
  return std::nullopt;
}

std::optional<std::size_t> Debugger::element_register(std::string_view name,
                                                      std::int32_t index) const {
  const auto* input = sources_.input(timeline_->ball().basic_area());
  if (input == nullptr)
    return std::nullopt;
  std::int32_t base = 0;
  std::int32_t size = bytecode::element_count;
  if (input->program->compiled) {
    const auto* array =
        symbol_called(*input->program->compiled, name, is_a(structured::SymbolKind::Array));
    if (array == nullptr)
      return std::nullopt;
    base = array->base;
    size = array->value;
  } else if (!equal_words(name, array_word)) {
    return std::nullopt;
  }
  if (index < 1 || index > size)
    return std::nullopt;
  return bytecode::first_element + static_cast<std::size_t>(base + index - 1);
}

std::optional<std::int32_t> Debugger::element(std::string_view name, std::int32_t index) const {
  const auto found = element_register(name, index);
  return found ? std::optional(timeline_->ball().machine().variable(*found)) : std::nullopt;
}

tl::expected<std::int32_t, std::string> Debugger::evaluate(std::string_view text) const {
  const auto expression = Expression::parse(text);
  if (!expression)
    return tl::unexpected(expression.error());
  return expression->value(*this);
}

tl::expected<std::int32_t, std::string> Debugger::set(std::string_view name,
                                                      std::string_view value) {
  const auto number = evaluate(value);
  if (!number)
    return number;
  name = trim(name);
  auto place = register_of(name);
  if (const auto open = name.find('['); open != std::string_view::npos && name.ends_with(']')) {
    const auto index = evaluate(name.substr(open + 1, name.size() - open - 2));
    if (!index)
      return index;
    place = element_register(trim(name.substr(0, open)), *index);
  }
  if (!place)
    return tl::unexpected(missing(name));
  if (!timeline_->change(SetVariable{*place, *number}))
    return tl::unexpected(std::string("no program is running"));
  return *number;
}

} // namespace orb::debug
