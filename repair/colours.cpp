#include "repair/colours.h"

#include "base/text/text.h"
#include "repair/idioms.h"
#include "repair/word_index.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::repair {
namespace {

struct Colour {
  std::string_view name; ///< as structured programs and tests write it
  std::uint32_t value;
  int code; ///< of LEDC; -1 without one
  std::string_view words;
};

constexpr auto colours = std::to_array<Colour>({
    {"red", 0xFF0000, 1, "red rot rojo roja rouge rosso rossa vermelho vermelha rood"},
    {"lime", 0x00FF00, 2, "green lime grün gruen verde vert verte groen"},
    {"blue", 0x0000FF, 3, "blue blau azul bleu blu azzurro blauw"},
    {"orange", 0xFF8000, 4, "orange naranja arancione laranja oranje"},
    {"purple", 0x8000FF, 5, "purple violet lila violett morado violeta viola roxo pourpre paars"},
    {"white", 0xFFFFFF, 6,
     "white weiß weiss blanco blanca blanc blanche bianco branco branca bianca wit"},
    {"yellow", 0xFFFF00, 7,
     "yellow gelb amarillo jaune giallo gialla amarilla amarela amarelo geel"},
    {"black", 0x000000, 0,
     "black off dark schwarz aus negro noir nero nera negra preta preto apagado éteint eteint "
     "spento zwart uit none"},
    {"aqua", 0x00FFFF, -1, "cyan aqua türkis turquoise lightblue hellblau skyblue celeste"},
    {"fuchsia", 0xFF00FF, -1, "magenta fuchsia"},
    {"#FF69B4", 0xFF69B4, -1, "pink rosa rose roze"},
    {"gray", 0x808080, -1, "gray grey grau gris grigio cinza grijs"},
    {"navy", 0x000080, -1, "navy darkblue dunkelblau marino"},
    {"teal", 0x008080, -1, "teal"},
    {"maroon", 0x800000, -1, "maroon darkred dunkelrot bordeaux"},
    {"silver", 0xC0C0C0, -1, "silver silber plata argento prata lightgray hellgrau"},
    {"#006400", 0x006400, -1, "darkgreen dunkelgrün"},
    {"#90EE90", 0x90EE90, -1, "lightgreen hellgrün"},
    {"#FFD700", 0xFFD700, -1, "gold dorado doré"},
    {"#8B4513", 0x8B4513, -1, "brown braun marrone marrom brun bruin"},
});

const Colour* named_colour(const Token& token) {
  if (!token.is_word() && !token.is_text())
    return nullptr;
  static const WordIndex index(colours, [](const Colour& one) { return one.words; });
  const auto& lists = index.lists_of(token.text);
  return lists.empty() ? nullptr : &colours[lists.front()];
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
  return named != nullptr ? std::optional(named->value) : std::nullopt;
}

std::optional<std::string> write_colour(std::string_view function, const Tokens& tokens) {
  if (tokens.size() != 1)
    return std::nullopt;
  const auto value = find_colour(tokens[0]);
  const auto* const named = named_colour(tokens[0]);
  if (!value)
    return std::nullopt;
  const auto hex = fmt::format("#{:06X}", *value);
  if (function == "rgb")
    return fmt::format("{}, {}, {}", *value >> 16, *value >> 8 & 0xFF, *value & 0xFF);
  if (function == "code")
    return named != nullptr && named->code >= 0 ? std::optional(std::to_string(named->code))
                                                : std::nullopt;
  if (named == nullptr)
    return hex;
  if (function == "testcolour")
    return std::string(named->name == "lime" && !equal_words("lime", tokens[0].text) ? "green"
                       : named->name == "black"                                      ? "off"
                       : named->name == "purple" || named->name == "orange" ||
                               named->name == "red" || named->name == "blue" ||
                               named->name == "lime" || named->name == "white" ||
                               named->name == "yellow"
                           ? named->name
                           : std::string_view(hex));
  // A word is translated by a word: the `green` of web pages is the darker one.
  if (named->name == "lime" && !equal_words("lime", tokens[0].text) && function == "colour")
    return "green";
  // Web pages' orange and purple are others; who writes the word means the word.
  const bool other = named->name == "purple" || named->name == "orange";
  return other && !equal_words(named->name, tokens[0].text) ? hex : std::string(named->name);
}

} // namespace orb::repair
