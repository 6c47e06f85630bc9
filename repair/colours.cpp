#include "repair/colours.h"

#include "base/text/text.h"
#include "repair/idioms.h"
#include "repair/word_index.h"
#include "spec/colours.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::repair {
namespace {

const spec::Colour* named_colour(const Token& token) {
  if (!token.is_word() && !token.is_text())
    return nullptr;
  static const WordIndex index(spec::colours, [](const spec::Colour& one) { return one.words; });
  const auto& lists = index.lists_of(token.text);
  return lists.empty() ? nullptr : &spec::colours[lists.front()];
}

/// The colour of LEDC with this name; nothing if there is none.
const spec::LedColour* led_colour(const spec::Colour* named) {
  const auto* const found =
      std::find_if(spec::led_colours.begin(), spec::led_colours.end(), [&](const auto& one) {
        return named != nullptr && holds(named->words, one.name);
      });
  return found == spec::led_colours.end() ? nullptr : found;
}

} // namespace

std::optional<std::uint32_t> find_colour(const Token& token) {
  if (token.kind == Token::Kind::Colour || (token.is_text() && token.text.starts_with('#'))) {
    auto digits = token.text.substr(1);
    if (digits.size() == 3)
      digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    return digits.size() == 6 ? parse_number<std::uint32_t>(digits, 16) : std::nullopt;
  }
  const auto* const named = named_colour(token);
  if (const auto* const led = led_colour(named)) // full brightness, as for lamps
    return led->red << 16 | led->green << 8 | led->blue;
  return named != nullptr ? std::optional(named->rgb) : std::nullopt;
}

std::optional<std::string> write_colour(std::string_view function, const Tokens& tokens) {
  const auto value = tokens.size() == 1 ? find_colour(tokens[0]) : std::nullopt;
  if (!value)
    return std::nullopt;
  if (function == "rgb")
    return fmt::format("{}, {}, {}", *value >> 16, *value >> 8 & 0xFF, *value & 0xFF);
  const auto* const named = named_colour(tokens[0]);
  const auto* const led = led_colour(named);
  if (function == "code")
    return led != nullptr ? std::optional(std::to_string(led->code)) : std::nullopt;
  if (function == "testcolour" && led != nullptr)
    return std::string(led->name);
  return named != nullptr && !named->name.empty() ? std::string(named->name)
                                                  : fmt::format("#{:06X}", *value);
}

} // namespace orb::repair
