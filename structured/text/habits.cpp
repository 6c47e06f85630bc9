// Words and signs of other languages.

#include "structured/text/messages.h"

#include "base/text/text.h"
#include "repair/idioms.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"
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
  Message help;
};

/// Where structured programs say it in another way than numbered ones.
const auto& structured_words() {
  static const auto words = std::to_array<Habit>({
      {"set", Where::Line, "", texts::Assignment()},
      {"int", Where::Line, "", texts::Assignment()},
      {"clear", Where::Line, "", texts::StartAt0()},
      {"begin", Where::Line, "", texts::NoBegin()},
      {"def", Where::Line, "", texts::WriteBlock("sub name", "end sub")},
      {"func", Where::Line, "", texts::WriteBlock("function name()", "end function")},
      {"proc", Where::Line, "", texts::WriteBlock("sub name", "end sub")},
      {"procedure", Where::Line, "", texts::WriteBlock("sub name", "end sub")},
      {"void", Where::Line, "", texts::WriteBlock("sub name", "end sub")},
      {"switch", Where::Line, "", texts::SelectInstead()},
      {"foreach", Where::Line, "", texts::WriteBlock("for n = 1 to 4", "next n")},
      {"forever", Where::Line, "", texts::WriteBlock("loop", "end loop")},
      {"rand", Where::Inside, "rnd", texts::DiceInstead()},
      {"random", Where::Inside, "rnd", texts::DiceInstead()},
      {"randint", Where::Inside, "rnd", texts::DiceInstead()},
      {"sqr", Where::Inside, "sqrt", texts::Write("sqrt(x)")},
      {"is", Where::Inside, "", texts::CaseLists()},
      {"heading", Where::Inside, "yaw", texts::HeadingIsYaw()},
      {"mod", Where::Inside, "%", texts::Write("a % b")},
      {"!", Where::Inside, "", texts::Write("not")},
      {"^", Where::Inside, "", texts::NoPower()},
      {"{", Where::Inside, "", texts::NoBraces()},
      {"}", Where::Inside, "", texts::NoBraces()},
      {"do", Where::Inside, "", texts::RemoveIt()},
      {"times", Where::Inside, "", {}},
  });
  return words;
}

} // namespace

Diagnostic habit(const Program& program, Span found, std::string_view instead, Message help) {
  auto d = finding(rules::ForeignWord, found, texts::NotOfThisLanguage(program.text_of(found)),
                   std::move(help));
  if (!instead.empty()) {
    const auto written = instead == " " ? std::string_view() : instead;
    d.help = written.empty() ? texts::RemoveIt() : texts::Write(trim(written));
    d.fix = Fix{d.help, {Edit{found, std::string(written)}}, Safety::Safe};
  }
  return d;
}

Diagnostic single_quotes(const Program& program, Span text) {
  const auto inner = program.text_of({text.begin + 1, text.end - 1});
  auto quoted = fmt::format("\"{}\"", inner);
  auto d = finding(rules::ForeignWord, text, texts::StartsComment(), texts::Write(quoted));
  if (inner.find('"') == std::string_view::npos)
    d.fix = Fix{d.help, {Edit{text, std::move(quoted)}}, Safety::Safe};
  return d;
}

std::optional<Diagnostic> foreign(const Program& program, Span word, Where where) {
  const auto text = program.text_of(word);
  const auto& words = structured_words();
  const auto* const row = std::find_if(words.begin(), words.end(), [&](const Habit& one) {
    return one.where == where && equal_words(one.word, text);
  });
  const bool listed = row != words.end();
  if (!listed && (find_word(text).kind == WordKind::Keyword || !repair::is_known_word(text, where)))
    return std::nullopt;
  auto d = habit(program, word, {}, listed ? row->help : Message());
  if (find_word(text).kind == WordKind::Statement)
    d.message = texts::StatementNoValue(text);
  if (listed && !row->instead.empty())
    d.fix =
        Fix{texts::Write(row->instead), {Edit{word, std::string(row->instead)}}, Safety::Unsafe};
  return d;
}

} // namespace orb::structured
