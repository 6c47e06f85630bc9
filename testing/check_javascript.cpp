#include "testing/check_javascript.h"

#include "base/cursor.h"
#include "testing/text/rules.h"
#include "testing/text/texts.h"
#include "testing/texts.h"

#include <algorithm>
#include <array>

namespace orb::testing {
namespace {

/// Words of the head about what is on the robot.
constexpr std::array on_the_robot{LineWord::With, LineWord::Target, LineWord::Firmware,
                                  LineWord::Area};

bool is_for_robot(std::string_view word) {
  return std::any_of(on_the_robot.begin(), on_the_robot.end(),
                     [&](LineWord one) { return info(one).word == word; });
}

/// Whether a line hands in a number, which only orbBasic asks for.
bool gives_number(const Source& source, std::uint32_t line) {
  vm::StimulusScript script;
  vm::read_stimulus_line(source, line, script);
  return !script.events.empty() &&
         std::holds_alternative<vm::stimulus::Number>(script.events.front().stimulus);
}

/// What a program that runs beside the robot cannot be asked for; empty for other expectations.
std::string_view of_robot_alone(const Expectation& one) {
  switch (one.word) {
  case Word::Variable: return one.name.text;
  case Word::Error: return one.error ? info(one.word).word : "";
  case Word::Marker:
  case Word::Asleep:
  case Word::Lines:
  case Word::Bytes: return info(one.word).word;
  case Word::Print:
  case Word::Prints:
  case Word::Near:
  case Word::Beyond:
  case Word::Inside:
  case Word::Stay:
  case Word::Heading:
  case Word::Speed:
  case Word::Moving:
  case Word::Resting:
  case Word::Distance:
  case Word::Color:
  case Word::BackLed:
  case Word::Collision:
  case Word::End: break;
  }
  return {};
}

} // namespace

void check_javascript(SuiteFile& file, std::string_view program) {
  const auto& source = *file.source;
  const auto& input = vm::stimulus_words[static_cast<std::size_t>(vm::StimulusWord::Input)];
  const auto refuse = [&](Span span, std::string_view word) {
    file.file.diagnostics.push_back(finding(
        rules::JavaScript, span, texts::NotOfJavaScript(word, program), file_texts::RemoveThat()));
  };
  for (std::uint32_t line = 1; line <= source.line_count(); ++line) {
    Cursor cursor(source, line);
    const auto span = cursor.peek_span();
    const auto word = cursor.word();
    if (is_for_robot(word)) {
      refuse(span, word);
    } else if (gives_number(source, line)) {
      cursor.take_rest();
      refuse(cursor.span_from(span.begin), input.word);
    }
  }
}

std::string where_tested(std::string_view program, const Say& say) {
  return say(texts::JavaScriptElsewhere(program)) + "\n";
}

bool refuse_of_robot(const Expectation& one, const Prepared& program, Lookup& found) {
  const auto word = of_robot_alone(one);
  if (word.empty())
    return false;
  found.rule = &rules::JavaScript;
  found.meaning.problem = texts::NotOfJavaScript(word, program.name);
  found.help = texts::OfJavaScript();
  return true;
}

void refuse_in_room(SuiteFile& file, const TestBall& ball) {
  file.file.diagnostics.push_back(
      finding(rules::JavaScript, ball.program.span,
              texts::NotOfJavaScript(info(LineWord::Ball).word, ball.program.text),
              texts::BallsRunOrbBasic()));
}

} // namespace orb::testing
