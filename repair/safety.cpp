#include "repair/safety.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/colours.h"
#include "repair/idioms.h"
#include "repair/line.h"
#include "repair/scenery.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

namespace orb::repair {
namespace notation {
namespace {

constexpr std::string_view new_line = "\n"; // the token between two lines

/// The numbers of tokens that correspond: in the line and in its replacement.
struct Advance {
  std::size_t said = 0;
  std::size_t written = 0;
};
using Advances = std::vector<Advance>;

const Token& nothing() {
  static const Token none;
  return none;
}

/// A position in the line, the position in the replacement to match, and their context.
struct Alignment {
  const Tokens& said;
  std::size_t i;
  const Tokens& written;
  std::size_t j;
  const Reading& reading;
  std::string_view head; ///< of the replacement
  int& parses_left;      ///< remaining budget of parses

  const Token& from(std::size_t n = 0) const {
    return i + n < said.size() ? said[i + n] : nothing();
  }
  const Token& to(std::size_t n = 0) const {
    return j + n < written.size() ? written[j + n] : nothing();
  }
  const Token& first() const { return said.empty() ? nothing() : said[0]; }
  const Token& first_written() const { return written.empty() ? nothing() : written[0]; }
  const Token& before() const { return i > 0 ? said[i - 1] : nothing(); }
  bool is_program() const {
    return reading.language == Language::Basic || reading.language == Language::Structured;
  }

  bool is_word(std::string_view word) const { return has_word(reading.words, word); }
  bool is_name(std::string_view word) const {
    return std::any_of(reading.names.begin(), reading.names.end(),
                       [&](const std::string& one) { return one == word; }) ||
           (reading.language == Language::Basic && word.size() == 1 &&
            to_lower(word[0]) != word[0]);
  }
  /// True if a word is unknown here.
  bool is_foreign(const Token& token) const {
    return token.is_word() && !is_word(token.text) && !is_name(token.text);
  }
};

/// True if a statement begins at a token.
bool begins_statement(const Tokens& tokens, std::size_t at) {
  return at == 0 || tokens[at - 1].is(":") || tokens[at - 1].is(new_line) ||
         tokens[at - 1].is("then") || tokens[at - 1].is("else") ||
         (at > 1 && tokens[at - 1].is(".") && begins_statement(tokens, at - 2)) ||
         (tokens[at - 1].is(";") && !tokens[0].is("print"));
}

/// True if a token ends a value; the next one, if it begins a value.
bool ends_value(const Token& token) {
  return token.kind != Token::Kind::Sign || token.is(")") || token.is("]");
}
bool begins_value(const Token& token) {
  return token.kind != Token::Kind::Sign || token.is("(") || token.is("-");
}

/// True if a token is an operator; `-` and `!` are signs.
bool is_operator(const Token& token) {
  return (token.is_word() && holds("and or not mod xor", token.text)) ||
         (token.kind == Token::Kind::Sign && !holds("( ) [ ] { } , ; : .", token.text) &&
          !token.is(new_line) && !token.text.empty());
}

// ---- numbers

bool is_unit_of_turns(const Token& token) {
  return token.is_word() && holds("deg degree degrees", token.text);
}

/// A unit of time. A variable of the same letter takes precedence.
std::int64_t unit_at(const Alignment& place, const Token& token) {
  const bool variable = place.is_name(token.text);
  return token.is_word() && !variable ? milliseconds_of(token.text) : 0;
}

/// A number in another notation, and the number of its tokens: `0x1F`, `3.0`, `1_000`, `2O0`.
struct Numeral {
  std::string digits;
  std::string unit; ///< as written; empty: none
  std::size_t tokens = 1;
};
std::optional<Numeral> number_at(const Alignment& place) {
  const auto& first = place.from();
  std::string text = first.text;
  Numeral number;
  if (first.is_number() && place.from(1).is_word() && !place.from(1).gap &&
      unit_at(place, place.from(1)) == 0) {
    text += place.from(1).text;
    number.tokens = 2;
  }
  if (!first.is_number() && (!place.is_foreign(first) || text.size() < 2))
    return std::nullopt;
  const auto small = lower(text);
  const auto in_base = [&](int base) -> std::optional<Numeral> {
    const auto value = parse_number<std::uint32_t>(small.substr(2), base);
    return value ? std::optional(Numeral{std::to_string(*value), {}, number.tokens}) : std::nullopt;
  };
  if (small.starts_with("0x"))
    return in_base(16);
  if (small.starts_with("0b"))
    return in_base(2);
  const auto end = text.find_last_of("0123456789oOIl") + 1;
  if (milliseconds_of(std::string_view(text).substr(end)) > 0) {
    number.unit = text.substr(end);
    text.resize(end);
  }
  const auto point = text.find('.');
  if (point != std::string::npos && text.find_first_not_of('0', point + 1) == std::string::npos)
    text.resize(point);
  if (number.tokens == 2)
    while (!text.empty() && std::string_view("uUlL").find(text.back()) != std::string_view::npos &&
           !is_digit(text.back()))
      text.pop_back(); // `1000UL`
  if (first.is_number())
    std::erase(text, '_');
  // Letters that look like digits must be fewer than the digits.
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return !is_digit(c); });
  if (letters * 2 >= static_cast<std::ptrdiff_t>(text.size()) + (first.is_number() ? 1 : 0))
    return std::nullopt;
  text = as_digits(std::move(text));
  const bool digits = !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
  number.digits = text;
  return digits ? std::optional(number) : std::nullopt;
}

Advances other_number(const Alignment& place) {
  const auto number = number_at(place);
  if (!number || !place.to().is_number() || place.to().text != number->digits)
    return {};
  if (number->unit.empty())
    return {{number->tokens, 1}};
  return place.to(1).is(number->unit) ? Advances{{number->tokens, 2}} : Advances();
}

/// `2 s` for `2s`, or for the milliseconds of orbBasic.
Advances same_time(const Alignment& place) {
  if (!place.from().is_number() || !place.to().is_number())
    return {};
  const auto unit = unit_at(place, place.from(1));
  if (unit == 0)
    return {};
  const auto written_unit = unit_at(place, place.to(1));
  if (written_unit == 0 && place.reading.language != Language::Basic)
    return {};
  constexpr std::size_t longest = 9; // digits; longer waits are unrealistic
  if (place.from().text.size() > longest || place.to().text.size() > longest)
    return {};
  const auto value = thousandths_in(place.from().text);
  const auto other = thousandths_in(place.to().text);
  const bool same =
      value && other && *value * unit == *other * std::max<std::int64_t>(written_unit, 1);
  return same ? Advances{{2, written_unit == 0 ? 1U : 2U}} : Advances();
}

Advances degrees(const Alignment& place) {
  return place.before().is_number() && is_unit_of_turns(place.from()) &&
                 place.is_foreign(place.from())
             ? Advances{{1, 0}}
             : Advances();
}

/// `B >= 2`: all numbers are whole.
Advances or_equal(const Alignment& place) {
  const bool least = place.from().is(">=") || place.from().is("=>");
  const bool most = place.from().is("<=") || place.from().is("=<");
  if (place.reading.language != Language::Basic || (!least && !most) ||
      !place.to().is(least ? ">" : "<"))
    return {};
  // and `A <= B`
  const auto& left = place.before();
  const auto& right = place.from(1);
  const bool twice = place.to(1).is(right.text) && place.to(2).is("or") &&
                     place.to(3).is(left.text) && place.to(4).is("=") && place.to(5).is(right.text);
  if (twice && place.i == 2 && place.from(2).is("then"))
    return {{2, 6}};
  const auto& next = place.from(2);
  const auto from = parse_number<std::int64_t>(place.from(1).text);
  const auto to = parse_number<std::int64_t>(place.to(1).text);
  const bool ends = !is_operator(next) || next.is_word() || next.is("&&") || next.is("||");
  return ends && from && to && *to == *from + (least ? -1 : 1) ? Advances{{2, 2}} : Advances();
}

/// `true` and `false` where only numbers exist.
Advances truth(const Alignment& place) {
  const auto* const number = place.from().is("true") || place.from().is("True")     ? "1"
                             : place.from().is("false") || place.from().is("False") ? "0"
                                                                                    : nullptr;
  return place.is_program() && number != nullptr && place.to().is(number) ? Advances{{1, 1}}
                                                                          : Advances();
}

/// Two notations of one colour: `red`, `rojo` or `#FF0000`, its three channels, or its code in
/// LEDC.
Advances colour(const Alignment& place) {
  if (!place.is_foreign(place.from()) && place.from().kind != Token::Kind::Colour)
    return {};
  const auto value = find_colour(place.from());
  if (value && place.before().is("LEDC") && write_colour("code", {place.from()}) == place.to().text)
    return {{1, 1}};
  if (value && place.to().is_word() && find_colour(place.to()) == value)
    return {{1, 1}};
  if (!value || place.written.size() < place.j + 5 || !place.to(1).is(",") || !place.to(3).is(","))
    return {};
  const auto part = [&](std::size_t at, unsigned shift) {
    return place.to(at).text == std::to_string(*value >> shift & UINT8_MAX);
  };
  return part(0, 16) && part(2, 8) && part(4, 0) ? Advances{{1, 5}} : Advances();
}

// ---- operators

std::string_view operator_called(const Token& token, Language language) {
  const bool basic = language == Language::Basic;
  const auto& text = token.text;
  if (text == "==" || text == ":=" || text == "===")
    return "=";
  if (text == "<>" || text == "!=" || text == "!==" || text == "~=" || (basic && text == "!"))
    return basic ? "!" : "!=";
  if (text == "&&")
    return "and";
  if (text == "||")
    return "or";
  if (text == "=<")
    return "<=";
  if (text == "=>")
    return ">=";
  if (token.is_word() && equal_words(text, "mod"))
    return "%";
  return text;
}

Advances same_operator(const Alignment& place) {
  const auto language = place.reading.language;
  return place.is_program() && !place.from().is_text() && !place.to().is_text() &&
                 operator_called(place.from(), language) == operator_called(place.to(), language) &&
                 is_operator(place.to())
             ? Advances{{1, 1}}
             : Advances();
}

/// `A += 2` and `A++`. An operand of several values is in parentheses, which close at the end.
Advances compound(const Alignment& place) {
  const auto& sign = place.from(1);
  const auto& name = place.from();
  const bool counts =
      begins_statement(place.said, place.i) && name.is_word() && place.to().is(name.text) &&
      ((sign.is("++") && place.to(1).is("+=")) || (sign.is("--") && place.to(1).is("-=")));
  if (counts && place.to(2).is("1"))
    return {{2, 3}};
  const bool begun = begins_statement(place.said, place.i) && name.is_word() &&
                     place.to().is_word() && place.to(2).is_word() &&
                     equal_words(place.to().text, name.text) &&
                     equal_words(place.to(2).text, name.text) && place.to(1).is("=");
  if (!begun || sign.text.size() != 2 || !place.to(3).is(sign.text.substr(0, 1)))
    return {};
  if (sign.is("++") || sign.is("--"))
    return place.to(4).is("1") ? Advances{{2, 5}} : Advances();
  if (sign.text[1] != '=')
    return {};
  if (place.i + 3 == place.said.size() || sign.is("+="))
    return {{2, 4}};
  return place.to(4).is("(") && close_of(place.written, place.j + 4) + 1 == place.written.size()
             ? Advances{{2, 5}}
             : Advances();
}
Advances compound_end(const Alignment& place) {
  const bool turned = place.written.size() > 3 && place.written[1].is("not") &&
                      place.written[2].is("(") && !has_token(place.said, "not");
  const bool sets =
      place.said.size() > 1 && place.said[1].text.size() == 2 && place.said[1].text[1] == '=';
  return place.i == place.said.size() && place.j + 1 == place.written.size() &&
                 place.to().is(")") && (sets || turned)
             ? Advances{{0, 1}}
             : Advances();
}

/// `print "n = " + N`: printed items are adjacent.
Advances joined_texts(const Alignment& place) {
  const bool beside = place.from().is("+") || place.from().is("&");
  return beside && place.is_program() && place.first().is("print") &&
                 (place.before().is_text() || place.from(1).is_text()) &&
                 !has_token(place.written, "+")
             ? Advances{{1, 0}}
             : Advances();
}

// ---- words

Advances same_token(const Alignment& place) {
  const auto& from = place.from();
  const auto& to = place.to();
  if (from.text.empty() && !from.is_text())
    return {};
  if (from.is_word() && to.is_word())
    return from.text == to.text || (equal_words(from.text, to.text) && !place.is_name(from.text))
               ? Advances{{1, 1}}
               : Advances();
  if (from.kind != to.kind || from.text != to.text)
    return {};
  if (!from.is_text() || from.closed)
    return {{1, 1}};
  // The closing quote is missing. If a value, a separator or another quote follows, the text ends
  // elsewhere.
  if (from.text.find('\'') != std::string::npos)
    return {};
  const auto inner = tokens_of(from.text, place.reading.language);
  const bool all = std::none_of(inner.begin(), inner.end(), [&](const Token& token) {
    return token.is(",") || token.is(";") || (token.is_word() && place.is_name(token.text)) ||
           (token.is_word() && place.is_program() && place.is_word(token.text));
  });
  return all && place.i + 1 == place.said.size() ? Advances{{1, 1}} : Advances();
}

/// A misspelt word: no other word is as close.
Advances misspelt(const Alignment& place) {
  constexpr std::size_t shortest = 3;
  const auto& word = place.from();
  const auto& meant = place.to();
  if (!place.is_foreign(word) || !meant.is_word() || word.text.size() < shortest ||
      is_known_word(word.text, Where::Line) || edit_distance(word.text, meant.text) != 1)
    return {};
  const auto as_near = [&](std::string_view other) {
    return !equal_words(other, meant.text) && edit_distance(word.text, other) == 1;
  };
  const bool alone =
      std::none_of(place.reading.words.begin(), place.reading.words.end(), as_near) &&
      std::none_of(place.reading.names.begin(), place.reading.names.end(), as_near);
  return alone && (place.is_word(meant.text) || place.is_name(meant.text)) ? Advances{{1, 1}}
                                                                           : Advances();
}

std::string letters_in(const Tokens& tokens, std::size_t at, std::size_t count) {
  std::string all;
  for (std::size_t n = 0; n < count; ++n)
    all += lower(tokens[at + n].text);
  std::erase(all, '_');
  return all;
}

/// Words split or joined: `endif`, `go to`, `wait for shake` if there is a `wait_for_shake`.
Advances together(const Alignment& place) {
  constexpr std::size_t most = 4;
  std::size_t apart = 0;
  while (apart < most && place.from(apart).is_word() && !place.from(apart).text.empty())
    ++apart;
  std::size_t words = 0;
  while (words < most && place.to(words).is_word() &&
         (place.is_word(place.to(words).text) || place.is_name(place.to(words).text)))
    ++words;
  const auto is_digit_perhaps = [](const std::string& name) { // `RGBO,0,0`
    return name == "O" || name == "o" || name == "l";
  };
  for (std::size_t n = 1; n <= apart; ++n)
    for (std::size_t m = 1; m <= words; ++m)
      if (n + m > 2 && !(m > n && is_digit_perhaps(place.to(m - 1).text)) &&
          letters_in(place.said, place.i, n) == letters_in(place.written, place.j, m))
        return {{n, m}};
  return {};
}

/// Block words of other BASIC dialects.
Advances block_words(const Alignment& place) {
  struct BlockWords {
    std::string_view theirs;
    std::string_view ours;
  };
  constexpr auto pairs =
      std::to_array<BlockWords>({{"do while", "while"},
                                 {"do until", "while not ("},
                                 {"loop while", "until not ("},
                                 {"loop until", "until"},
                                 {"end procedure", "end sub"},
                                 {"end func", "end function"},
                                 {"end for", "next"},
                                 {"exit sub", "return"},
                                 {"break", "exit"}, // inside a case repair/keeping.cpp removes it
                                 {"default", "else"},
                                 {"do", "repeat"},
                                 {"do", "loop"},
                                 {"loop", "end while"},
                                 {"loop", "end loop"}});
  if (place.reading.language != Language::Structured || !begins_statement(place.said, place.i))
    return {};
  const auto says = [](const Tokens& tokens, std::size_t at, std::string_view phrase) {
    const auto words = words_in(phrase);
    std::size_t n = 0;
    while (n < words.size() && at + n < tokens.size() && equal_words(tokens[at + n].text, words[n]))
      ++n;
    return n == words.size() ? n : 0;
  };
  for (const auto& pair : pairs)
    if (const Advance step{says(place.said, place.i, pair.theirs),
                           says(place.written, place.j, pair.ours)};
        step.said > 0 && step.written > 0)
      return {step};
  return {};
}

/// `delay500` and `1to5`.
Advances number_behind(const Alignment& place) {
  if (!place.is_foreign(place.from()) || !place.to().is_word() || !place.is_word(place.to().text) ||
      !place.to(1).is_number())
    return {};
  const bool unit = place.to(2).is_word() && !place.to(2).gap;
  for (std::size_t n = unit ? 3 : 2; n > 1; --n)
    if (letters_in(place.written, place.j, n) == lower(place.from().text))
      return {{1, n}};
  return {};
}

/// `wenn` and `sonst`: the word in another natural language.
Advances spoken(const Alignment& place) {
  constexpr std::size_t shortest = 2;
  return place.is_foreign(place.from()) && place.from().text.size() >= shortest &&
                 place.to().is_word() && place.is_word(place.to().text) &&
                 word_at(place.said, place.i) == lower(place.to().text)
             ? Advances{{1, 1}}
             : Advances();
}

/// Another word for a statement with the same values: `println A`, `Serial.println(A)`, `elif A =
/// 1`. A single word is not enough evidence, except for `endif` and the like.
Advances foreign_statement(const Alignment& place) {
  if (!begins_statement(place.said, place.i) || !begins_statement(place.written, place.j) ||
      !place.to().is_word() || !place.is_word(place.to().text))
    return {};
  std::size_t last = 0;
  while (place.from(last).is_word() && place.is_foreign(place.from(last)) &&
         place.from(last + 1).is(".") && place.from(last + 2).is_word())
    last += 2;
  const auto& word = place.from(last);
  const bool own = (word.is("?") && last == 0) || // `roll` alone is a sensor
                   (word.is("roll") && place.to().is("goroll") && !place.from(last + 1).is("="));
  const bool object = last > 0 && equal_words(word.text, place.to().text);
  const bool known = place.is_foreign(word) && is_known_word(word.text, Where::Line);
  if (!own && !object && !known)
    return {};
  const bool closes =
      place.to().is("end") && place.to(1).is_word() && place.is_word(place.to(1).text);
  if (closes)
    return place.i + last + 1 == place.said.size() ? Advances{{last + 1, 2}} : Advances();
  const bool alone = place.i + last + 1 == place.said.size() || place.from(last + 1).is(":");
  return alone && !equal_words(place.to().text, "else") ? Advances() : Advances{{last + 1, 1}};
}

/// Words without a meaning here: `let A = 1`, `while A < 3 do`.
Advances filler(const Alignment& place) {
  const auto& word = place.from();
  if ((place.is_word(word.text) && !equal_words(word.text, "let")) || place.is_name(word.text))
    return {};
  const bool sets = begins_statement(place.said, place.i) && holds("let var int call", word.text) &&
                    place.from(1).is_word();
  const bool does = word.is("do") && place.i > 0 && place.i + 1 == place.said.size();
  const bool clears = word.is("cls") && place.said.size() == 1; // there is no screen
  return word.is_word() && (sets || does || clears) ? Advances{{1, 0}} : Advances();
}

// ---- signs

/// True if the replacement parses with some tokens changed.
bool parses(const Alignment& place, const Tokens& tokens) {
  std::string text(place.head);
  text += join(tokens);
  return --place.parses_left < 0 || // unknown
         (text.find('\n') == std::string::npos && place.reading.parses(text));
}

Tokens with(Tokens tokens, std::size_t at, const Token& token) {
  tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(at), token);
  return tokens;
}

/// True if an inserted sign has only one possible position: anywhere else the line does not parse
/// with it.
bool stands_here_only(const Alignment& place) {
  auto without = place.written;
  const auto sign = without[place.j];
  without.erase(without.begin() + static_cast<std::ptrdiff_t>(place.j));
  const auto joins = [&](std::size_t at) { // `then` is never next to an operator
    return sign.is_word() &&
           (is_operator(without[at - 1]) || (at < without.size() && is_operator(without[at])));
  };
  for (std::size_t at = 1; at <= without.size(); ++at)
    if (at != place.j && !joins(at) && parses(place, with(without, at, sign)))
      return false;
  return true;
}

/// True if parentheses are redundant: they contain one value, or the whole of a statement or of an
/// operand between two commas.
bool is_idle(const Tokens& tokens, std::size_t open, std::size_t close) {
  if (close >= tokens.size() || close < open + 2)
    return false;
  const auto inner = slice(tokens, open + 1, close);
  const auto& before = open > 0 ? tokens[open - 1] : nothing();
  const auto& after = close + 1 < tokens.size() ? tokens[close + 1] : nothing();
  const bool calls = before.is_word() && !tokens[open].gap;
  const bool operand =
      before.is_word() && !begins_statement(tokens, open - 1) && holds("* / % + -", after.text);
  if (inner.size() == 1)
    return !operand; // the operand of `rnd 256 - 1` is ambiguous
  const bool computes = std::any_of(inner.begin(), inner.end(), [](const Token& token) {
    return token.is_relation() || (token.is_word() && is_operator(token));
  });
  const bool begun = (before.is_word() && (begins_statement(tokens, open - 1) ||
                                           holds("if elseif while until to step", before.text))) ||
                     before.is(",") || before.is("(") || (before.is("=") && !computes);
  const bool ended = after.text.empty() || after.is(",") || after.is(")") || after.is("then") ||
                     after.is("goto") || after.is("to") || after.is("step") || after.is("{") ||
                     after.is(":") || after.is(";") || after.is(new_line);
  const bool values = has_token(inner, ",");
  return begun && ended &&
         (!values || (before.is_word() && (calls || begins_statement(tokens, open - 1))));
}

/// The opening bracket for a closing one; the number of tokens if there is none.
std::size_t open_of(const Tokens& tokens, std::size_t close) {
  for (std::size_t open = 0; open < close; ++open)
    if (tokens[open].is("(") && close_of(tokens, open) == close)
      return open;
  return tokens.size();
}

bool is_idle_at(const Tokens& tokens, std::size_t at) {
  return tokens[at].is("(") ? is_idle(tokens, at, close_of(tokens, at))
                            : open_of(tokens, at) < at && is_idle(tokens, open_of(tokens, at), at);
}

/// True if a bracket has no partner.
bool is_lone(const Tokens& tokens, std::size_t at) {
  return tokens[at].is("(") ? close_of(tokens, at) == tokens.size()
                            : open_of(tokens, at) == tokens.size();
}

/// True if a bracket closed earlier would change the value: `(A + 1 / 2`.
bool matters_where_closed(const Tokens& tokens, std::size_t open, std::size_t close) {
  const auto sum = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(open),
                                tokens.begin() + static_cast<std::ptrdiff_t>(close),
                                [](const Token& token) { return token.is("+") || token.is("-"); });
  return std::any_of(
      sum, tokens.begin() + static_cast<std::ptrdiff_t>(close),
      [](const Token& token) { return token.is("*") || token.is("/") || token.is("%"); });
}

Advances bracket_in(const Alignment& place) {
  if (!(place.to().is("(") || place.to().is(")")))
    return {};
  if (place.reading.language == Language::Structured && place.to(1).is(")") && place.j > 0 &&
      place.is_name(place.written[place.j - 1].text))
    return {{0, 2}}; // a call without values
  const auto opens = place.to().is("(") ? place.j : open_of(place.written, place.j);
  const bool lacked =
      opens < place.written.size() && has_token(place.said, place.to().is("(") ? ")" : "(");
  if (lacked && place.to().is(")") && matters_where_closed(place.written, opens, place.j))
    return {};
  return is_idle_at(place.written, place.j) || (lacked && stands_here_only(place))
             ? Advances{{0, 1}}
             : Advances();
}

/// An extra bracket: with its partner added, the line would mean something else, or nothing.
bool lacks_other(const Alignment& place) {
  const bool opens = place.from().is("(");
  Token other = place.from();
  other.text = opens ? ")" : "(";
  const auto both = with(place.written, place.j, place.from());
  for (std::size_t at = opens ? place.j + 1 : 1; at <= (opens ? both.size() : place.j); ++at) {
    const auto whole = with(both, at, other);
    const auto open = opens ? place.j : at;
    if (!is_idle(whole, open, close_of(whole, open)) && parses(place, whole))
      return true;
  }
  return false;
}

Advances bracket_out(const Alignment& place) {
  if (!(place.from().is("(") || place.from().is(")")))
    return {};
  const bool lone = is_lone(place.said, place.i);
  return is_idle_at(place.said, place.i) || (lone && !lacks_other(place)) ? Advances{{1, 0}}
                                                                          : Advances();
}

/// `[` and `{` for `(`.
Advances other_bracket(const Alignment& place) {
  const bool opens = (place.from().is("[") || place.from().is("{")) && place.to().is("(");
  const bool closes = (place.from().is("]") || place.from().is("}")) && place.to().is(")");
  return opens || closes ? Advances{{1, 1}} : Advances();
}

/// A missing comma between two adjacent values, where the line would not parse with the two joined
/// or with an operator between them.
Advances comma_in(const Alignment& place) {
  if (!place.to().is(",") || place.j == 0 || place.j + 1 >= place.written.size() || place.i == 0 ||
      !ends_value(place.before()) || !begins_value(place.from()) || place.from().is("-") ||
      is_operator(place.before()) || is_operator(place.from()) ||
      place.first_written().is("print") || place.first_written().is("data") ||
      begins_statement(place.said, place.i - 1))
    return {};
  auto sum = place.written;
  sum[place.j].text = "+";
  auto one = place.written;
  one[place.j - 1].text += one[place.j + 1].text;
  one.erase(one.begin() + static_cast<std::ptrdiff_t>(place.j),
            one.begin() + static_cast<std::ptrdiff_t>(place.j) + 2);
  return parses(place, sum) || parses(place, one) ? Advances() : Advances{{0, 1}};
}

/// An extra comma where no value can be missing.
Advances comma_out(const Alignment& place) {
  if (!place.from().is(",") || place.said.size() == 1)
    return {};
  if (!place.is_program())
    return {{1, 0}}; // spaces separate values
  const bool parts = place.i > 0 && place.i + 1 < place.said.size() && ends_value(place.before()) &&
                     begins_value(place.from(1)) && !begins_statement(place.said, place.i - 1);
  if (parts)
    return {};
  Token value;
  value.kind = Token::Kind::Number;
  value.text = "1";
  value.gap = true;
  const auto both = with(place.written, place.j, place.from());
  for (const auto at : {place.j, place.j + 1})
    if (parses(place, with(both, at, value)))
      return {};
  return {{1, 0}};
}

Advances other_comma(const Alignment& place) {
  return place.to().is(",") && !place.first().is("print") &&
                 (place.from().is(";") || place.from().is(".") || place.from().is(":"))
             ? Advances{{1, 1}}
             : Advances();
}

/// `;`, `:` and `{` at the end, as in other languages.
Advances at_end(const Alignment& place) {
  const auto& sign = place.from();
  return (sign.is(";") || sign.is(":") || sign.is("{")) && place.i + 1 == place.said.size() &&
                 !(sign.is(";") && place.first().is("print") && place.is_program())
             ? Advances{{1, 0}}
             : Advances();
}

/// A type sign of a name: `$a`, `@a`, `A%`.
Advances sigil(const Alignment& place) {
  const auto& sign = place.from();
  const bool front = (sign.is("$") || sign.is("@") || sign.is("#")) && place.from(1).is_word() &&
                     !place.from(1).gap && !(place.i > 0 && place.before().is_word() && !sign.gap);
  const bool behind = (sign.is("%") || sign.is("&") || sign.is("!")) && place.before().is_word() &&
                      !sign.gap && !begins_value(place.from(1));
  return front || behind ? Advances{{1, 0}} : Advances();
}

/// A sign between the line number and the statement: `10) LEDC 1`, `10: LEDC 1`.
Advances behind_number(const Alignment& place) {
  const auto& sign = place.from();
  return place.reading.language == Language::Basic && place.i == 0 && place.said.size() > 1 &&
                 (sign.is(")") || sign.is(".") || sign.is(":"))
             ? Advances{{1, 0}}
             : Advances();
}

/// A `then` that a condition lacks, or writes as a colon.
Advances then_in(const Alignment& place) {
  const bool colon = place.from().is(":") && place.first().is("if") &&
                     !has_token(place.said, "then") && place.is_program();
  if (colon && place.to().is("then"))
    return {{1, 1}};
  return place.to().is("then") && place.is_program() && place.first_written().is("if") &&
                 !has_token(place.said, "then") && stands_here_only(place)
             ? Advances{{0, 1}}
             : Advances();
}

/// `then 60`: a number there can only be a jump target.
Advances goto_in(const Alignment& place) {
  return place.reading.language == Language::Basic && place.to().is("goto") &&
                 (place.before().is("then") || place.before().is("else")) &&
                 place.from().is_number() && place.i + 1 == place.said.size()
             ? Advances{{0, 1}}
             : Advances();
}

/// A label before a statement: jumps to it get the number of its line.
Advances label_out(const Alignment& place) {
  const auto& name = place.from();
  const bool stands = place.i == 0 && name.is_word() && !place.is_word(name.text) &&
                      place.from(1).is(":") && place.said.size() > 2;
  return stands && place.reading.number_of && !place.reading.number_of(name.text).empty()
             ? Advances{{2, 0}}
             : Advances();
}

/// A label, replaced by the number of its line.
Advances label(const Alignment& place) {
  const bool jumps = place.before().is("goto") || place.before().is("gosub");
  return jumps && place.from().is_word() && place.reading.number_of &&
                 place.reading.number_of(place.from().text) == place.to().text
             ? Advances{{1, 1}}
             : Advances();
}

/// Several statements on a line. After a condition they would depend on it.
Advances next_line(const Alignment& place) {
  const bool depends = std::any_of(place.said.begin(), place.said.end(), [](const Token& token) {
    return token.is("if") || token.is("else");
  });
  const bool parts = place.from().is(":") || (place.from().is(";") && !place.first().is("print"));
  return place.to().is(new_line) && parts && !depends ? Advances{{1, 1}} : Advances();
}

/// Two adjacent statements: the second begins with its keyword, and only this split parses.
Advances line_in(const Alignment& place) {
  const bool depends = has_token(place.said, "if") || has_token(place.said, "else");
  // `print print` is one word too many.
  if (!place.to().is(new_line) || depends || place.i < 2 || !place.from().is_word() ||
      !place.is_word(place.from().text) || is_operator(place.before()) ||
      std::count_if(place.written.begin(), place.written.end(),
                    [](const Token& token) { return token.is(new_line); }) > 1)
    return {};
  for (std::size_t at = 1; at < place.said.size(); ++at)
    if (at != place.i && parses(place, slice(place.said, 0, at)) &&
        parses(place, slice(place.said, at)))
      return {};
  return {{0, 1}};
}

/// A remark that is a jump target and ends the program.
Advances end_at_remark(const Alignment& place) {
  if (place.said.size() == 1 && place.from().is("cls") && place.written.size() == 1 &&
      place.to().is("end"))
    return {{1, 1}};
  return place.said.empty() && place.written.size() == 1 && place.to().is("end") ? Advances{{0, 1}}
                                                                                 : Advances();
}

/// `}` in a structured program closes the open block.
Advances brace(const Alignment& place) {
  if (place.reading.language != Language::Structured || place.i != 0 || !place.from().is("}"))
    return {};
  if (place.said.size() > 1)
    return place.to().is("else") || place.to().is("elseif") ? Advances{{1, 0}} : Advances();
  if (place.to().is("next"))
    return {{1, 1}};
  return place.to().is("end") ? Advances{{1, 2}} : Advances();
}

/// `id 40` and `id: 40` for `id=40`.
Advances slot_sign(const Alignment& place) {
  const bool slot = place.reading.language == Language::Macro && place.before().is("id");
  if (!slot || !place.to().is("="))
    return {};
  if (place.from().is(":"))
    return {{1, 1}};
  return place.from().is_number() ? Advances{{0, 1}} : Advances();
}

struct Row {
  Notation notation;
  Advances (*steps)(const Alignment&);
};

constexpr auto basic = Language::Basic;
constexpr auto structured = Language::Structured;

/// The differences that only concern notation.
constexpr auto rows = std::to_array<Row>({
    {{"the same, in capitals, quotes or blanks", basic, "10 PRINT 'hi'", "10 print \"hi\""},
     same_token},
    {{"a number", basic, "10 delay 0x64", "10 delay 100"}, other_number},
    {{"a time", basic, "10 delay 1.5 s", "10 delay 1500"}, same_time},
    {{"degrees", basic, "10 goroll 90 deg,100,1", "10 goroll 90,100,1"}, degrees},
    {{"or equal", basic, "10 if A >= 2 then end", "10 if A > 1 then end"}, or_equal},
    {{"a truth", basic, "10 A = true", "10 A = 1"}, truth},
    {{"a colour", basic, "10 RGB #FF8000", "10 RGB 255, 128, 0"}, colour},
    {{"an operator", basic, "10 if A == 1 && B <> 2 then end", "10 if A = 1 and B ! 2 then end"},
     same_operator},
    {{"an operator that sets", basic, "10 A -= B * 2", "10 A = A - (B * 2)"}, compound},
    {{"its end", basic, "10 A *= B + 2", "10 A = A * (B + 2)"}, compound_end},
    {{"texts that are joined", basic, "10 print \"n = \" + N", "10 print \"n = \" N"},
     joined_texts},
    {{"a misspelt word", basic, "10 pirnt A", "10 print A"}, misspelt},
    {{"words apart or together", structured, "endif", "end if"}, together},
    {{"words of a block", structured, "do while speed > 5", "while speed > 5"}, block_words},
    {{"a word and its number", basic, "10 delay500", "10 delay 500"}, number_behind},
    {{"a word of another tongue", basic, "10 wenn A = 1 then end", "10 if A = 1 then end"}, spoken},
    {{"another word for a statement", basic, "10 Serial.println(A)", "10 print A"},
     foreign_statement},
    {{"a word that says nothing", basic, "10 let A = 1", "10 A = 1"}, filler},
    {{"a bracket", basic, "10 delay 5)", "10 delay 5"}, bracket_out},
    {{"a bracket that lacks", basic, "10 A = (B + 1", "10 A = (B + 1)"}, bracket_in},
    {{"another bracket", basic, "10 A = rnd[6]", "10 A = rnd(6)"}, other_bracket},
    {{"a comma", basic, "10 RGB 255 0 9", "10 RGB 255, 0, 9"}, comma_in},
    {{"a comma too many", basic, "10 RGB, 1,2,3", "10 RGB 1,2,3"}, comma_out},
    {{"another sign for a comma", basic, "10 RGB 1;2;3", "10 RGB 1,2,3"}, other_comma},
    {{"a sign at the end", structured, "delay 2s;", "delay 2s"}, at_end},
    {{"the kind of a name", structured, "print $speed", "print speed"}, sigil},
    {{"a sign behind a line's number", basic, "10) LEDC 1", "10 LEDC 1"}, behind_number},
    {{"then", basic, "10 if A = 1 goto 40", "10 if A = 1 then goto 40"}, then_in},
    {{"goto", basic, "10 if A = 1 then 40", "10 if A = 1 then goto 40"}, goto_in},
    {{"a label of a line", basic, "40 again: LEDC 1", "40 LEDC 1"}, label_out},
    {{"a label", basic, "10 goto again", "10 goto 40"}, label},
    {{"lines", basic, "10 A = 1: B = 2", "10 A = 1\n11 B = 2"}, next_line},
    {{"lines side by side", basic, "10 RGB 255,0,0 delay 500", "10 RGB 255,0,0\n11 delay 500"},
     line_in},
    {{"a remark at the end", basic, "90 REM done", "90 end ' done"}, end_at_remark},
    {{"a brace", structured, "}", "end while"}, brace},
    {{"the sign of a slot", Language::Macro, ".macro m id 40", ".macro m id=40"}, slot_sign},
});

/// Searches for a sequence of rows that turns one line into the other.
class Way {
public:
  Way(const Tokens& said, const Tokens& written, const Reading& reading, std::string_view head)
      : said_(said), written_(written), reading_(reading), head_(head) {}

  bool leads(std::size_t i = 0, std::size_t j = 0) {
    if (i == said_.size() && j == written_.size())
      return true;
    if (!seen_.emplace(i, j).second)
      return false;
    const Alignment place{said_, i, written_, j, reading_, head_, parses_left_};
    return std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
      const auto steps = row.steps(place);
      return std::any_of(steps.begin(), steps.end(), [&](const Advance& step) {
        return i + step.said <= said_.size() && j + step.written <= written_.size() &&
               leads(i + step.said, j + step.written);
      });
    });
  }

private:
  const Tokens& said_;
  const Tokens& written_;
  const Reading& reading_;
  std::string_view head_;
  std::set<std::pair<std::size_t, std::size_t>> seen_; ///< dead ends
  int parses_left_ = 500;
};

std::string_view words_of(std::string_view comment) {
  return trim(comment.substr(std::min<std::size_t>(comment.size(), 1)));
}

} // namespace
} // namespace notation

std::vector<std::string> defined_names(const Source& source, Language language) {
  std::set<std::string> names;
  for (std::uint32_t n = 1; n <= source.line_count(); ++n) {
    const auto tokens = split(source.line(n).substr(0, longest_line), language).tokens;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (!tokens[i].is_word())
        continue;
      const auto& next = i + 1 < tokens.size() ? tokens[i + 1] : notation::nothing();
      const bool first = i == 0 || tokens[i - 1].is(":") || tokens[i - 1].is("then") ||
                         tokens[i - 1].is(",") || tokens[i - 1].is("(");
      const bool declared = i > 0 && holds("sub function for const var array dim def "
                                           "input read .macro .const macro",
                                           tokens[i - 1].text);
      const bool parameter = i > 2 && (tokens[0].is("sub") || tokens[0].is("function"));
      const bool set = next.is("=") && (first || declared || i == 1);
      if (declared || parameter || set || (i == 0 && next.is(":")) || (i == 0 && next.is("[")))
        names.insert(tokens[i].text);
    }
  }
  return {names.begin(), names.end()};
}

bool says_the_same(std::string_view said, std::string_view written, const Reading& reading) {
  if (said.starts_with("> ")) // an interactive prompt
    said.remove_prefix(2);
  const auto from = split(said, reading.language);
  Tokens tokens;
  std::string comment;
  std::string head;
  for (bool first = true; first || !written.empty(); first = false) {
    const auto end = std::min(written.find_first_of("\r\n"), written.size());
    auto line = split(written.substr(0, end), reading.language);
    written.remove_prefix(std::min(written.find_first_not_of("\r\n", end), written.size()));
    if (first)
      head = line.head;
    else
      tokens.push_back({Token::Kind::Sign, std::string(notation::new_line), false});
    append(tokens, line.tokens);
    comment += line.comment;
  }
  // Another number is another line. If no statement is left, no number has to be kept.
  if ((trim(head) != trim(from.head) && !tokens.empty()) ||
      notation::words_of(comment) != notation::words_of(from.comment) ||
      from.tokens.size() > most_tokens || tokens.size() > 2 * most_tokens)
    return false;
  return notation::Way(from.tokens, tokens, reading, head).leads();
}

std::vector<Notation> notations() {
  std::vector<Notation> all;
  for (const auto& row : notation::rows)
    all.push_back(row.notation);
  return all;
}

} // namespace orb::repair
