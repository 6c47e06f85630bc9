#include "repair/line_repair.h"

#include "base/text/text.h"
#include "repair/arrange.h"
#include "repair/colours.h"
#include "repair/fill.h"
#include "repair/units.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

// What a line that is offered keeps of the one that was written: an answer that loses what was said
// is worse than none.

namespace orb::repair {

/// Whether a statement can mean what the line says.
bool LineRepair::keeps_meaning(std::string_view statement) const {
  const auto equals = statement.find(" = ");
  const bool assigns = equals != std::string_view::npos;
  if (assigns && statement.substr(0, equals) == statement.substr(equals + 3))
    return false; // nobody sets a variable to itself
  if (sets_name() && !assigns && !statement.starts_with("read ") &&
      !statement.starts_with("input "))
    return false;
  const auto& tokens = parts_.tokens;
  if (has_token(tokens, "then") && !tokens.back().is("then") && statement.ends_with(" then"))
    return false; // what is to be done was said
  const auto joined = std::find_if(tokens.begin(), tokens.end(),
                                   [](const Token& token) { return token.is("and"); });
  const bool asks_twice = !tokens.empty() && holds("if elseif while until", tokens[0].text) &&
                          statement.starts_with(tokens[0].text) && tokens.end() - joined > 3;
  if (asks_twice && !has_token(tokens_of(statement, judge_.language), "and"))
    return false; // half of what is asked for
  if (statement.starts_with("print \"") && calls_with_name())
    return false; // no text
  if (statement.find("\ncase ") != std::string_view::npos)
    return false; // a case without lines of its own
  const bool one_word = tokens.size() == 1 && is_foreign(tokens[0].text);
  if (judge_.language == Language::Structured && statement == "print" && one_word &&
      !equal_words(tokens[0].text, "say"))
    return false; // of what?
  if (judge_.language == Language::Macro && !keeps_operands(statement))
    return false;
  if (judge_.language == Language::Test && statement.starts_with("expect ") &&
      std::any_of(tokens.begin(), tokens.end(), [](const Token& token) {
        return token.is_word() && (token.is("not") || is_called("never", token.text) ||
                                   mean_the_same("not", token.text));
      }))
    return false; // the opposite
  return keeps_names(statement) && !invents_macro(statement) && !adds_condition(statement);
}

/// Whether what is computed still is: `rnd 255` is not 255.
bool LineRepair::keeps_functions(std::string_view lines) const {
  if (!is_program())
    return true;
  const auto said = split(line_, judge_.language).tokens;
  const auto kept = tokens_of(lines, judge_.language);
  const auto count = [](const Tokens& tokens, std::string_view word) {
    return std::count_if(tokens.begin(), tokens.end(),
                         [&](const Token& token) { return equal_words(token.text, word); });
  };
  constexpr std::array<std::string_view, 3> functions = {"abs", "rnd", "sqrt"};
  return std::all_of(functions.begin(), functions.end(),
                     [&](std::string_view word) { return count(kept, word) >= count(said, word); });
}

/// Whether two numbers became one: `130 136` are two values that lack a comma, `10 000` is one.
bool LineRepair::joins_numbers(std::string_view lines) const {
  if (!is_program())
    return false;
  const auto said = split(line_, judge_.language).tokens;
  const auto kept = tokens_of(lines, judge_.language);
  for (std::size_t i = 1; i < said.size(); ++i)
    if (said[i - 1].is_number() && said[i].is_number() &&
        said[i].text.find_first_not_of('0') != std::string::npos &&
        has_token(kept, said[i - 1].text + said[i].text))
      return true;
  return false;
}

/// Whether a macro gets a number that nobody wrote: `play(true)` names none.
bool LineRepair::invents_macro(std::string_view statement) const {
  constexpr std::string_view macrun = "macrun ";
  if (!statement.starts_with(macrun))
    return false;
  const auto said = split(line_, judge_.language).tokens;
  const bool sounds = std::any_of(said.begin(), said.end(), [](const Token& token) {
    return holds("sound sounds music audio speaker tone song", token.text);
  });
  return sounds || (is_digit(statement[macrun.size()]) &&
                    std::none_of(said.begin(), said.end(),
                                 [](const Token& token) { return token.is_number(); }));
}

/// Whether something is called with a name of the program: `len(a)`.
bool LineRepair::calls_with_name() const {
  const auto& tokens = parts_.tokens;
  for (std::size_t i = 0; i + 3 < tokens.size(); ++i)
    if (tokens[i].is_word() && tokens[i + 1].is("(") && !tokens[i + 1].gap &&
        has_word(names_, tokens[i + 2].text) && (tokens[i + 3].is(")") || tokens[i + 3].is(",")))
      return true;
  return false;
}

/// Whether the operands of a command are still there: a line with numbers is not left out, and a
/// macro that has a name is no number.
bool LineRepair::keeps_operands(std::string_view statement) const {
  const auto& tokens = parts_.tokens;
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
    return false; // what are the others for?
  return tokens.size() != 2 || !holds("goto gosub on_collision", tokens[0].text) ||
         !tokens[1].is_word() || !is_digit(statement.back());
}

/// Whether the line gives a value to a name that other lines use.
bool LineRepair::sets_name() const {
  const auto& tokens = parts_.tokens;
  return judge_.language == Language::Structured && tokens.size() > 2 && tokens[1].is("=") &&
         has_word(names_, tokens[0].text) && !has_word(judge_.words, tokens[0].text);
}

/// Whether a line that leaves something still does: without it, a loop is endless. In a `select`
/// there is nothing to leave.
bool LineRepair::keeps_leaving(std::string_view lines) const {
  const auto leaving =
      std::find_if(parts_.tokens.begin(), parts_.tokens.end(), [](const Token& token) {
        return holds("break return continue exit", token.text);
      });
  if (leaving == parts_.tokens.end() || misplaced_ || judge_.language == Language::Test)
    return true;
  const auto kept = tokens_of(lines, judge_.language);
  const bool leaves = std::any_of(kept.begin(), kept.end(), [](const Token& token) {
    return holds("exit return continue goto abort", token.text);
  });
  if (leaving->is("break") && leaving == parts_.tokens.begin() && around_.closer == "end select")
    return !leaves;
  const bool ends = !kept.empty() && kept.back().is("end"); // `exit()`, `return 0` of a program
  return leaves || (ends && !leaving->is("break") && !leaving->is("continue"));
}

/// Whether a unit became a condition of its own: `if who = 0 people then`.
bool LineRepair::adds_condition(std::string_view statement) const {
  if (has_token(parts_.tokens, "and"))
    return false;
  const auto tokens = tokens_of(statement, judge_.language);
  for (std::size_t i = 2; i < tokens.size(); ++i)
    if (tokens[i].is("then") && tokens[i - 2].is("and"))
      return true;
  return false;
}

/// Whether the names of the program are still there that are the values of a statement: in a line
/// of other words they may be words, too.
bool LineRepair::keeps_names(std::string_view statement) const {
  if (parts_.tokens.empty() || !has_word(judge_.words, parts_.tokens[0].text) ||
      parts_.tokens[0].is("end"))
    return true;
  const auto is_name = [&](const std::string& word) {
    return judge_.language == Language::Basic
               ? word.size() == 1 && word[0] == to_upper(word[0])
               : judge_.language == Language::Structured && has_word(names_, word) &&
                     !has_word(judge_.words, word) && milliseconds_of(word) == 0;
  };
  const auto kept = tokens_of(statement, judge_.language);
  const auto count = [](const Tokens& tokens, std::string_view word) {
    return std::count_if(tokens.begin(), tokens.end(),
                         [&](const Token& token) { return token.is(word); });
  };
  return std::all_of(parts_.tokens.begin(), parts_.tokens.end(), [&](const Token& token) {
    return !token.is_word() || !is_name(token.text) ||
           count(kept, token.text) >= count(parts_.tokens, token.text);
  });
}

namespace {

/// What a test expects between slashes, with them: the words of another language. Empty without.
std::string_view pattern_of(std::string_view line) {
  const auto print = line.find("print ");
  const auto first = print == std::string_view::npos ? print : line.find('/', print);
  const auto last = line.rfind('/');
  return first == std::string_view::npos || last == first ? std::string_view()
                                                          : line.substr(first, last + 1 - first);
}

} // namespace

/// Whether what was quoted is still there: nobody writes a text for nothing.
bool LineRepair::keeps_texts(std::string_view lines) const {
  if (judge_.language == Language::Test && !lines.empty() &&
      lines.find(pattern_of(line_)) == std::string_view::npos)
    return false;
  const auto unquoted = [](std::string_view text) {
    std::string plain(text);
    std::erase(plain, '"');
    return plain;
  };
  const bool says_using =
      std::any_of(parts_.tokens.begin(), parts_.tokens.end(),
                  [](const Token& token) { return equal_words(token.text, "using"); });
  return lines.empty() || unquoted(lines) == unquoted(line_) ||
         std::all_of(parts_.tokens.begin(), parts_.tokens.end(), [&](const Token& token) {
           const bool filled =
               token.text.find_first_of("{%\\") != std::string::npos ||
               (token.text.find('#') != std::string::npos && says_using) ||
               (judge_.language == Language::Macro && // quoted numbers
                token.text.find_first_not_of("0123456789 ,.;") == std::string::npos);
           return !token.is_text() || !token.closed || filled || find_colour(token) ||
                  lines.find(token.text) != std::string_view::npos;
         });
}

} // namespace orb::repair
