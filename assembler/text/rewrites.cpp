#include "assembler/text/rewrites.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "spec/macro.h"

#include <algorithm>
#include <array>
#include <string>

namespace orb::assembler {
namespace {

using repair::Token;
using repair::Tokens;

bool has_word(const Tokens& line, std::size_t at, std::string_view word) {
  return at < line.size() && line[at].is_word() && equal_words(line[at].text, word);
}

bool is_command(const Token& token) {
  return token.is_word() && spec::find_macro_command(lower(token.text)) != nullptr;
}

void unquote(Tokens& line) {
  if (line[0].is("comment"))
    return;
  Tokens all;
  for (const auto& token : line) {
    auto parts =
        token.is_text() ? repair::tokens_of(token.text, repair::Language::Macro) : Tokens{token};
    if (!parts.empty())
      parts[0].gap = token.gap;
    repair::append(all, parts);
  }
  line = std::move(all);
}

void drop_brackets(Tokens& line) {
  for (std::size_t i = line.size(); i-- > 0;)
    if (line[i].kind == Token::Kind::Sign && holds("[ ] { } ;", line[i].text))
      repair::take_out(line, i, 1);
  if (line.size() > 1 && line[0].is("-") && line[1].is_word())
    line.erase(line.begin());
  while (!line.empty() && line.back().is(","))
    line.pop_back();
}

void drop_objects(Tokens& line) {
  if (has_word(line, 0, "await"))
    line.erase(line.begin());
  while (line.size() > 2 && line[0].is_word() && line[1].is(".") && line[2].is_word()) {
    const std::ptrdiff_t first = is_command(line[0]) ? 1 : 0;
    line.erase(line.begin() + first, line.begin() + first + 2);
  }
}

void drop_parentheses(Tokens& line) {
  if (std::any_of(line.begin(), line.end(), [](const Token& token) {
        return token.is("+") || token.is("*") || token.is("/");
      }))
    return; // they may belong to a sum
  for (std::size_t i = line.size(); i-- > 0;)
    if (line[i].is("(") || line[i].is(")")) {
      const bool opens = line[i].is("(");
      repair::take_out(line, i, 1);
      if (opens && i < line.size())
        line[i].gap = true;
    }
}

void read_hexadecimal(Tokens& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool sign = line[i].is("$") || line[i].is("&");
    std::string digits;
    auto end = i + (sign ? 1 : 0);
    const auto first = end;
    while (end < line.size() && (line[end].is_word() || line[end].is_number()) &&
           (end == first || !line[end].gap))
      digits += lower(line[end++].text);
    const bool marked = line[i].is("$") || (line[i].is("&") && digits.starts_with('h')) ||
                        (!sign && digits.ends_with('h') && is_digit(digits[0]));
    std::erase_if(digits, [](char c) { return c == 'h' || c == 'x'; });
    constexpr std::size_t colour = 6; // digits
    const auto value = parse_number<std::uint32_t>(digits, 16);
    if (!marked || !value)
      continue;
    line[i] = sign && digits.size() == colour
                  ? Token{Token::Kind::Colour, "#" + digits, line[i].gap}
                  : Token{Token::Kind::Number, std::to_string(*value), line[i].gap};
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(i) + 1,
               line.begin() + static_cast<std::ptrdiff_t>(end));
  }
}

void join_decimals(Tokens& line) {
  const auto* info = spec::find_macro_command(line[0].text);
  if (info == nullptr || info->operand_count != 1 || line.size() < 4 || !line[1].is_number() ||
      !line[2].is(",") || !line[3].is_number() || line[3].gap)
    return;
  constexpr std::size_t thousand = 3; // digits
  const bool thousands = line.size() == 4 && line[3].text.size() == thousand;
  line[1].text += (thousands ? "" : ".") + line[3].text;
  line.erase(line.begin() + 2, line.begin() + 4);
}

/// True if a line that is not a command gives an id.
bool says_id(const Tokens& line) {
  return !is_command(line[0]) && std::any_of(line.begin() + 1, line.end(), [](const Token& token) {
    return token.is_word() && equal_words(token.text, "id");
  });
}

void begin_macro(Tokens& line) {
  constexpr std::size_t most = 4; // tokens, including a label
  const auto word = [](const Token& token) {
    return std::string_view(token.text).substr(token.text.starts_with('.') ? 1 : 0);
  };
  std::size_t at = 0;
  while (at < most && at < line.size() &&
         !(line[at].is_word() && repair::is_called(".macro", word(line[at]))))
    ++at;
  const bool begins = at < most && at < line.size();
  const bool directive =
      begins && at == 0 && (line[0].text[0] == '.' || equal_words(line[0].text, "macro"));
  const bool labels = line[0].text[0] == '.' || (line.size() > 1 && line[1].is(":"));
  if (!directive && !((begins || labels) && says_id(line)) &&
      !(begins && at == 0 && line.size() == 2))
    return;
  if (begins) { // `start macro spin`, `spin: macro`
    const auto word_at = line.begin() + static_cast<std::ptrdiff_t>(at);
    line.erase(at == 1 ? line.begin() : word_at, word_at + 1);
  } else if (line[0].text[0] == '.') // `.mcaro`
    line.erase(line.begin());
  line.insert(line.begin(), Token{Token::Kind::Word, ".macro"});
}

void part_id(Tokens& line) {
  constexpr std::string_view id = "id";
  for (std::size_t i = 2; i < line.size(); ++i) {
    const std::string_view digits =
        std::string_view(line[i].text).substr(std::min(id.size(), line[i].text.size()));
    if (!line[0].is(".macro") || !line[i].is_word() || !line[i].text.starts_with(id) ||
        !parse_number<int>(digits))
      continue;
    const Token number{Token::Kind::Number, std::string(digits), true};
    line[i].text = id;
    line.insert(line.begin() + static_cast<std::ptrdiff_t>(i) + 1, number);
  }
}

constexpr auto all = std::to_array<Rewrite>({
    {"reads words in quotes, but no comment", unquote, R"("delay": "200")", "delay: 200"},
    {"drops brackets, dashes and what ends a statement", drop_brackets, "- fade: [50, 0, 8, 140],",
     "fade: 50, 0, 8, 140"},
    {"drops what a function is called of", drop_objects, "await rgb.Set(255, 0, 0)",
     "rgb(255, 0, 0)"},
    {"takes values out of parentheses", drop_parentheses, "fade((60, 0, 40), 2500)",
     "fade 60, 0, 40, 2500"},
    {"reads hexadecimal numbers and colours", read_hexadecimal, "rgb $FF 0C8h &H00FFFF",
     "rgb 255 200 #00ffff"},
    {"reads a decimal comma", join_decimals, "delay 1,5s", "delay 1.5s"},
    {"begins a macro with `.macro`", begin_macro, "square: macro id=50", ".macro square: id=50"},
    {"parts `id` and its number", part_id, ".macro wink id40", ".macro wink id 40"},
});

} // namespace

std::span<const Rewrite> rewrites() {
  return all;
}

} // namespace orb::assembler
