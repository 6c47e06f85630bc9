#include "repair/keeping.h"

#include "base/text/text.h"
#include "repair/colours.h"
#include "repair/fill.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <string>

namespace orb::repair {
namespace {

/// True if the line assigns a name that other lines use.
bool sets_name(const Line& line) {
  const auto& tokens = line.tokens;
  return line.language() == Language::Structured && tokens.size() > 2 && tokens[1].is("=") &&
         line.has_name(tokens[0].text) && !line.knows(tokens[0].text);
}

/// True if a name of the program is an argument of a call: `len(a)`.
bool calls_with_name(const Line& line) {
  const auto& tokens = line.tokens;
  for (std::size_t i = 0; i + 3 < tokens.size(); ++i)
    if (tokens[i].is_word() && tokens[i + 1].is("(") && !tokens[i + 1].gap &&
        line.has_name(tokens[i + 2].text) && (tokens[i + 3].is(")") || tokens[i + 3].is(",")))
      return true;
  return false;
}

/// True if the operands of a command are preserved: a line with numbers must not be removed, and a
/// macro's name is not a number.
bool keeps_operands(const Line& line, std::string_view statement) {
  const auto& tokens = line.tokens;
  if (statement.empty())
    return std::none_of(tokens.begin(), tokens.end(),
                        [](const Token& token) { return token.is_number(); });
  const bool pair = tokens.size() == 3 && tokens[1].is_number() && tokens[2].is_number() &&
                    tokens[1].text != tokens[2].text;
  const auto numbers = std::count_if(tokens.begin(), tokens.end(),
                                     [](const Token& token) { return token.is_number(); });
  if ((pair || numbers > 2) &&
      (statement.starts_with("delay ") || statement.starts_with(".const ")) &&
      statement.find('\n') == std::string_view::npos)
    return false; // the others would be lost
  return tokens.size() != 2 || !holds("goto gosub on_collision", tokens[0].text) ||
         !tokens[1].is_word() || !is_digit(statement.back());
}

/// True if a unit became a condition: `if who = 0 people then`.
bool adds_condition(const Line& line, std::string_view statement) {
  if (has_token(line.tokens, "and"))
    return false;
  const auto tokens = tokens_of(statement, line.language());
  for (std::size_t i = 2; i < tokens.size(); ++i)
    if (tokens[i].is("then") && tokens[i - 2].is("and"))
      return true;
  return false;
}

/// True if the program's names that are values of a statement are preserved. In a line of other
/// words they may be ordinary words.
bool keeps_names(const Line& line, std::string_view statement) {
  if (line.tokens.empty() || !line.knows(line.tokens[0].text) || line.tokens[0].is("end"))
    return true;
  const auto is_name = [&](const std::string& word) {
    return line.language() == Language::Basic
               ? word.size() == 1 && word[0] == to_upper(word[0])
               : line.language() == Language::Structured && line.has_name(word) &&
                     !line.knows(word) && milliseconds_of(word) == 0;
  };
  const auto kept = tokens_of(statement, line.language());
  const auto count = [](const Tokens& tokens, std::string_view word) {
    return std::count_if(tokens.begin(), tokens.end(),
                         [&](const Token& token) { return token.is(word); });
  };
  return std::all_of(line.tokens.begin(), line.tokens.end(), [&](const Token& token) {
    return !token.is_word() || !is_name(token.text) ||
           count(kept, token.text) >= count(line.tokens, token.text);
  });
}

/// True if a macro gets a number that was not written: `play(true)` has none.
bool invents_macro(const Line& line, std::string_view statement) {
  constexpr std::string_view macrun = "macrun ";
  if (!statement.starts_with(macrun))
    return false;
  const auto said = split(line.written, line.language()).tokens;
  const bool sounds = std::any_of(said.begin(), said.end(), [](const Token& token) {
    return holds("sound sounds music audio speaker tone song", token.text);
  });
  return sounds || (statement.size() > macrun.size() && is_digit(statement[macrun.size()]) &&
                    std::none_of(said.begin(), said.end(),
                                 [](const Token& token) { return token.is_number(); }));
}

/// True if computations are preserved: `rnd 255` is not 255.
bool keeps_functions(const Line& line, std::string_view lines) {
  if (!line.is_program())
    return true;
  const auto said = split(line.written, line.language()).tokens;
  const auto kept = tokens_of(lines, line.language());
  const auto count = [](const Tokens& tokens, std::string_view word) {
    return std::count_if(tokens.begin(), tokens.end(),
                         [&](const Token& token) { return equal_words(token.text, word); });
  };
  constexpr std::array<std::string_view, 3> functions = {"abs", "rnd", "sqrt"};
  return std::all_of(functions.begin(), functions.end(),
                     [&](std::string_view word) { return count(kept, word) >= count(said, word); });
}

/// True if two numbers were joined: `130 136` is two values without a comma, `10 000` is one.
bool joins_numbers(const Line& line, std::string_view lines) {
  if (!line.is_program())
    return false;
  const auto said = split(line.written, line.language()).tokens;
  const auto kept = tokens_of(lines, line.language());
  for (std::size_t i = 1; i < said.size(); ++i)
    if (said[i - 1].is_number() && said[i].is_number() &&
        said[i].text.find_first_not_of('0') != std::string::npos &&
        has_token(kept, said[i - 1].text + said[i].text))
      return true;
  return false;
}

/// True if an exit is preserved: without it, a loop is endless. In a `select` there is nothing to
/// exit.
bool keeps_leaving(const Line& line, std::string_view lines) {
  const auto leaving = std::find_if(line.tokens.begin(), line.tokens.end(), [](const Token& token) {
    return holds("break return continue exit", token.text);
  });
  if (leaving == line.tokens.end() || line.misplaced || line.language() == Language::Test)
    return true;
  const auto kept = tokens_of(lines, line.language());
  const bool leaves = std::any_of(kept.begin(), kept.end(), [](const Token& token) {
    return holds("exit return continue goto abort", token.text);
  });
  if (leaving->is("break") && line.around.closer == "end select")
    return !leaves;
  const bool ends = !kept.empty() && kept.back().is("end"); // `exit()`, `return 0` of a program
  return leaves || (ends && !leaving->is("break") && !leaving->is("continue"));
}

/// The pattern between slashes that a test expects, slashes included; empty if there is none. It is
/// in another language.
std::string_view pattern_of(std::string_view line) {
  const auto print = line.find("print ");
  const auto first = print == std::string_view::npos ? print : line.find('/', print);
  const auto last = line.rfind('/');
  return first == std::string_view::npos || last == first ? std::string_view()
                                                          : line.substr(first, last + 1 - first);
}

/// True if quoted text is preserved.
bool keeps_texts(const Line& line, std::string_view lines) {
  if (line.language() == Language::Test && !lines.empty() &&
      lines.find(pattern_of(line.written)) == std::string_view::npos)
    return false;
  const auto unquoted = [](std::string_view text) {
    std::string plain(text);
    std::erase(plain, '"');
    return plain;
  };
  return lines.empty() || unquoted(lines) == unquoted(line.written) ||
         std::all_of(line.tokens.begin(), line.tokens.end(), [&](const Token& token) {
           const bool filled =
               token.text.find_first_of("{%\\") != std::string::npos ||
               (line.language() == Language::Macro && // quoted numbers
                token.text.find_first_not_of("0123456789 ,.;") == std::string::npos);
           return !token.is_text() || !token.closed || filled || find_colour(token) ||
                  lines.find(token.text) != std::string_view::npos;
         });
}

} // namespace

bool keeps_meaning(const Line& line, std::string_view statement) {
  const auto equals = statement.find(" = ");
  const bool assigns = equals != std::string_view::npos;
  if (assigns && statement.substr(0, equals) == statement.substr(equals + 3))
    return false; // an assignment to itself is pointless
  if (sets_name(line) && !assigns && !statement.starts_with("read ") &&
      !statement.starts_with("input "))
    return false;
  const auto& tokens = line.tokens;
  if (has_token(tokens, "then") && !tokens.back().is("then") && statement.ends_with(" then"))
    return false; // the action would be lost
  const auto joined = std::find_if(tokens.begin(), tokens.end(),
                                   [](const Token& token) { return token.is("and"); });
  const bool asks_twice = !tokens.empty() && holds("if elseif while until", tokens[0].text) &&
                          statement.starts_with(tokens[0].text) && tokens.end() - joined > 3;
  if (asks_twice && !has_token(tokens_of(statement, line.language()), "and"))
    return false; // half of the statement would be lost
  if (statement.starts_with("print \"") && calls_with_name(line))
    return false; // not a text
  if (statement.find("\ncase ") != std::string_view::npos)
    return false; // a case without lines
  const bool one_word = tokens.size() == 1 && line.is_foreign(tokens[0].text);
  if (line.language() == Language::Structured && statement == "print" && one_word &&
      !equal_words(tokens[0].text, "say"))
    return false; // the operand is unknown
  if (line.language() == Language::Macro && !keeps_operands(line, statement))
    return false;
  if (line.language() == Language::Test && statement.starts_with("expect ") &&
      std::any_of(tokens.begin(), tokens.end(), negates))
    return false; // the opposite
  return keeps_names(line, statement) && !invents_macro(line, statement) &&
         !adds_condition(line, statement);
}

bool keeps_parts(const Line& line, std::string_view lines) {
  return keeps_texts(line, lines) && keeps_leaving(line, lines) && keeps_functions(line, lines) &&
         !joins_numbers(line, lines);
}

} // namespace orb::repair
