// Words and signs of other languages.

#include "structured/text/messages.h"

#include "base/text/text.h"
#include "repair/idioms.h"
#include "structured/text/rules.h"
#include "structured/text/words.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace orb::structured {
namespace {

using repair::Where;

/// A word of another language, in small letters, and what helps.
struct Habit {
  std::string_view word;
  Where where;
  std::string_view instead; ///< empty where a person has to write the line
  std::string_view help;
};

constexpr auto no_braces = "blocks have no braces; they end with `next`, `end if`, `end while` …";

/// Where structured programs say it in another way than numbered ones.
constexpr auto structured_words = std::to_array<Habit>({
    {"set", Where::Line, "", "an assignment is `x = 5`"},
    {"int", Where::Line, "", "an assignment is `x = 5`"},
    {"clear", Where::Line, "", "variables start at 0; or write `x = 0`"},
    {"begin", Where::Line, "", "blocks need no `begin`; remove the line"},
    {"def", Where::Line, "", "write `sub name` … `end sub`"},
    {"func", Where::Line, "", "write `function name()` … `end function`"},
    {"proc", Where::Line, "", "write `sub name` … `end sub`"},
    {"procedure", Where::Line, "", "write `sub name` … `end sub`"},
    {"void", Where::Line, "", "write `sub name` … `end sub`"},
    {"switch", Where::Line, "", "write `select e`, `case 1` … `end select`"},
    {"foreach", Where::Line, "", "write `for n = 1 to 4` … `next n`"},
    {"forever", Where::Line, "", "write `loop` … `end loop`"},
    {"rand", Where::Inside, "rnd", "write `rnd(6)` for 1 to 6"},
    {"random", Where::Inside, "rnd", "write `rnd(6)` for 1 to 6"},
    {"randint", Where::Inside, "rnd", "write `rnd(6)` for 1 to 6"},
    {"sqr", Where::Inside, "sqrt", "write `sqrt(x)`"},
    {"is", Where::Inside, "",
     "`case` lists values: `case 6 to 100`; for other conditions write `if`"},
    {"heading", Where::Inside, "yaw",
     "`heading` sets the heading; the direction of the ball is `yaw`"},
    {"mod", Where::Inside, "%", "write `a % b`"},
    {"!", Where::Inside, "", "write `not`"},
    {"^", Where::Inside, "", "there is no power operator: write `a * a`"},
    {"{", Where::Inside, "", no_braces},
    {"}", Where::Inside, "", no_braces},
    {"do", Where::Inside, "", "remove it"},
    {"times", Where::Inside, "", ""},
});

} // namespace

Diagnostic habit(const Program& program, Span found, std::string_view instead,
                 std::string_view help) {
  auto d = finding(rules::ForeignWord, found,
                   fmt::format("`{}` is not part of this language", program.text_of(found)),
                   std::string(help));
  if (!instead.empty()) {
    const auto written = instead == " " ? std::string_view() : instead;
    d.help = written.empty() ? "remove it" : fmt::format("write `{}`", trim(written));
    d.fix = Fix{d.help, {Edit{found, std::string(written)}}, Safety::Safe};
  }
  return d;
}

Diagnostic single_quotes(const Program& program, Span text) {
  const auto inner = program.text_of({text.begin + 1, text.end - 1});
  auto d = finding(rules::ForeignWord, text, "`'` starts a comment, not a string",
                   fmt::format("write `\"{}\"`", inner));
  if (inner.find('"') == std::string_view::npos)
    d.fix = Fix{d.help, {Edit{text, fmt::format("\"{}\"", inner)}}, Safety::Safe};
  return d;
}

std::optional<Diagnostic> foreign(const Program& program, Span word, Where where) {
  const auto text = program.text_of(word);
  const auto row =
      std::find_if(structured_words.begin(), structured_words.end(), [&](const Habit& one) {
        return one.where == where && equal_words(one.word, text);
      });
  const bool listed = row != structured_words.end();
  if (!listed && (find_word(text).kind == WordKind::Keyword || !repair::is_known_word(text, where)))
    return std::nullopt;
  auto d = habit(program, word, {}, listed ? row->help : std::string_view());
  if (find_word(text).kind == WordKind::Statement)
    d.message = fmt::format("`{}` is a statement, not a value", text);
  if (listed && !row->instead.empty())
    d.fix = Fix{fmt::format("write `{}`", row->instead),
                {Edit{word, std::string(row->instead)}},
                Safety::Unsafe};
  return d;
}

} // namespace orb::structured
