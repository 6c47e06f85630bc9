#include "testing/text/file_reader.h"

#include "base/fixes.h"
#include "base/meant.h"
#include "testing/text/documented_form.h"
#include "testing/text/doubts.h"

#include <iterator>

namespace orb::testing {

TestFile FileReader::read() {
  for (std::uint32_t line = 1; line <= source_.line_count(); ++line)
    has_tests_ = has_tests_ || first_word(line) == "test";
  if (!has_tests_) {
    file_.tests.push_back(new_test());
    file_.tests.back().name = {std::string(stem(source_.name())), {0, 0}};
  }
  for (std::uint32_t line = 1; line <= source_.line_count(); ++line)
    read_line(line);
  for (auto& test : file_.tests)
    complete(test);
  auto doubts = find_doubts(source_, file_);
  file_.diagnostics.insert(file_.diagnostics.end(), std::make_move_iterator(doubts.begin()),
                           std::make_move_iterator(doubts.end()));
  sort_by_place(file_.diagnostics);
  return std::move(file_);
}

std::string_view FileReader::first_word(std::uint32_t line) {
  return Cursor(source_, line).word();
}

Test FileReader::new_test() const {
  Test test;
  test.seeds = seeds_.value_or(Seeds{});
  test.bound = bound_.value_or(default_bound);
  return test;
}

void FileReader::read_line(std::uint32_t line) {
  Cursor cursor(source_, line, file_.diagnostics, rules::Syntax, rules::Value);
  if (cursor.at_end())
    return;
  if (prints_ && cursor.peek_char() == '"') {
    current().expectations.back().texts.push_back(cursor.quoted());
    return end_of_line(cursor);
  }
  prints_ = false;
  const auto word = cursor.peek();
  const auto* row = find_word<LineInfo>(line_words, word);
  if (row == nullptr)
    return read_stimulus(cursor, word, line);
  const auto span = cursor.peek_span();
  cursor.word();
  if (row->stands == Stands::Head && has_tests_ && !file_.tests.empty()) {
    cursor.fail_at(span, rules::Place, file_texts::AfterATest(word), file_texts::MoveAbove());
    file_.diagnostics.back().fix = move_up(line);
    return;
  }
  if (row->stands == Stands::InTest && file_.tests.empty())
    return cursor.fail_at(span, rules::Place, file_texts::BeforeFirstTest(word),
                          file_texts::MoveBelow());
  read_row(static_cast<LineWord>(row - line_words.data()), cursor, span, line);
}

Fix FileReader::move_up(std::uint32_t line) const {
  const auto begin = source_.line_start(file_.tests.front().line);
  const auto text = fmt::format("{}{}", trim(source_.line(line)), line_end_of(source_.text()));
  return {file_texts::MoveLine(),
          {{{begin, begin}, text}, {{source_.line_start(line), source_.line_start(line + 1)}, {}}},
          Safety::Unsafe};
}

void FileReader::read_row(LineWord word, Cursor& cursor, Span span, std::uint32_t line) {
  const auto& slots = info(word).slots;
  const auto value = [&] { return cursor.read(slots[0]); };
  switch (word) {
  case LineWord::Program: read_file(cursor, slots[0], file_.program); break;
  case LineWord::Ball: read_ball(cursor); break;
  case LineWord::With:
    do
      file_.with.push_back(named(value()));
    while (!cursor.at_end() && !cursor.failed());
    break;
  case LineWord::Course: read_file(cursor, slots[0], file_.course); break;
  case LineWord::Target: read_target(cursor, value()); break;
  case LineWord::Firmware: read_firmware(cursor, value()); break;
  case LineWord::Area:
    file_.target.area = value().which == 0 ? spec::Area::Ram : spec::Area::Flash;
    break;
  case LineWord::Seeds: seeds_ = read_seeds(cursor, value()); break;
  case LineWord::For: bound_ = read_bound(cursor, value()); break;
  case LineWord::Test: return read_test(cursor, span, line);
  case LineWord::Expect:
  case LineWord::Never: return read_expectation(cursor, span, line, word == LineWord::Never);
  case LineWord::Reach: return read_reach(cursor, span, line);
  }
  end_of_line(cursor);
}

void FileReader::end_of_line(Cursor& cursor) {
  if (!cursor.failed() && !cursor.at_end())
    cursor.fail(rules::Syntax, file_texts::Unexpected(cursor.peek()), file_texts::CommentsStart());
}

void FileReader::read_stimulus(Cursor& cursor, std::string_view word, std::uint32_t line) {
  const bool known = word == "at" || find_word<vm::StimulusInfo>(vm::stimulus_words, word);
  if (!known && !parse_duration(word))
    return unknown_word(cursor, word);
  const auto span = cursor.take_rest();
  vm::StimulusScript script;
  vm::read_stimulus_line(source_, line, script);
  file_.diagnostics.insert(file_.diagnostics.end(), script.diagnostics.begin(),
                           script.diagnostics.end());
  if (script.events.empty())
    return;
  auto text = std::string(source_.text(span));
  if (word != "at" && word != "wall")
    text.insert(0, "at 0s ");
  if (file_.tests.empty()) {
    head_.push_back(script.events.front());
    head_lines_.push_back(std::move(text));
  } else {
    current().stimuli.push_back(script.events.front());
    current().stimulus_lines.push_back(std::move(text));
  }
}

void FileReader::unknown_word(Cursor& cursor, std::string_view word) {
  if (find_word<ExpectationInfo>(expectations, word) != nullptr)
    return cursor.fail(
        rules::Word, file_texts::CannotStart(word),
        file_texts::WriteEither(fmt::format("expect {}", word), fmt::format("never {}", word)));
  auto known = words_of(line_words, &WordInfo::word);
  const auto lines = listed(known);
  for (const auto& row : vm::stimulus_words)
    known.push_back(row.word);
  cursor.fail(rules::Word, file_texts::UnknownWord(word),
              meant_or(word, known, file_texts::LinesStartWith(lines)));
}

void FileReader::complete(Test& test) {
  auto stimuli = head_;
  stimuli.insert(stimuli.end(), test.stimuli.begin(), test.stimuli.end());
  vm::sort_by_time(stimuli);
  test.stimuli = std::move(stimuli);
  test.stimulus_lines.insert(test.stimulus_lines.begin(), head_lines_.begin(), head_lines_.end());
  if (!has_tests_) {
    test.seeds = seeds_.value_or(test.seeds);
    test.bound = bound_.value_or(test.bound);
  }
  bool speaks_of_errors = false;
  for (const auto& one : test.expectations) {
    speaks_of_errors = speaks_of_errors ||
                       (one.word == Word::Error && (!one.never || !one.error)) ||
                       (one.other && one.other->word == Word::Error);
  }
  if (speaks_of_errors)
    return;
  Expectation silent;
  silent.never = true;
  test.expectations.push_back(std::move(silent));
}

namespace {

std::vector<std::string_view> all_words() {
  auto words = operand_words();
  words.push_back("end");
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows)
      words.push_back(row.word);
  };
  add(line_words);
  add(expectations);
  add(when_words);
  add(join_words);
  add(vm::stimulus_words);
  const auto colours = structured::colour_names();
  words.insert(words.end(), colours.begin(), colours.end());
  return words;
}

/// Collects what the meaning of a line may depend on.
SurroundingText read_surroundings(const Source& source) {
  SurroundingText found;
  found.bound = default_bound;
  // a sign that the author thinks of zones
  for (const auto* word : {"insid", "reach", "zone", "stay"})
    found.may_have_zones = found.may_have_zones || source.text().find(word) != std::string::npos;
  for (std::uint32_t n = 1; n <= source.line_count(); ++n) {
    Cursor cursor(source, n);
    found.has_texts = found.has_texts || cursor.peek_char() == '"';
    const auto word = cursor.word();
    found.has_course = found.has_course || word == info(LineWord::Course).word;
    found.may_have_zones = found.may_have_zones || found.has_course;
    if (word == info(LineWord::For).word) {
      found.has_bound = true;
      found.bound = parse_duration(cursor.word()).value_or(default_bound);
    }
    auto* by = static_cast<std::string*>(nullptr);
    for (auto next = cursor.word(); !next.empty() && !cursor.at_end(); next = cursor.word()) {
      if (next == info(Word::Near).word)
        by = &found.near_by;
      else if (next == info(Word::Heading).word)
        by = &found.heading_by;
      else if (next == "by" && by != nullptr && is_digit(cursor.peek_char()))
        *by = cursor.peek();
    }
  }
  return found;
}

/// True if a line expects the value of a variable whose name is also something else to expect. Only
/// this spelling can mean the variable.
bool makes_variable(std::string_view line) {
  const auto equals = line.find(" = ");
  if (equals == std::string_view::npos)
    return false;
  const auto before = line.substr(0, equals);
  const auto word = before.substr(before.find_last_of(' ') + 1);
  return find_word<ExpectationInfo>(expectations, word) != nullptr;
}

/// Offers a corrected line for each error.
void offer_lines(const Source& source, std::vector<Diagnostic>& findings) {
  repair::Dialect dialect;
  dialect.language = repair::Language::Test;
  dialect.words = all_words();
  const auto elsewhere = read_surroundings(source);
  dialect.parses = [elsewhere, words = dialect.words](std::string_view line) {
    const auto tokens = repair::tokens_of(line, repair::Language::Test);
    if (!tokens.empty() && tokens[0].is_word() &&
        std::find(words.begin(), words.end(), tokens[0].text) == words.end())
      return false;
    if (!elsewhere.may_have_zones && (line.find(info(Word::Inside).word) != std::string::npos ||
                                      line.find(info(LineWord::Reach).word) != std::string::npos))
      return false;
    if (makes_variable(line))
      return false;
    const auto reads = [&](std::string_view above, std::string_view below) {
      return FileReader(Source({}, fmt::format("{}{}{}", above, line, below)))
          .read()
          .diagnostics.empty();
    };
    return reads("test \"x\"\n", "") || reads("", "") || reads("", "\n  expect resting") ||
           reads("test \"x\"\nexpect prints\n", "");
  };
  dialect.rephrase = [elsewhere](const repair::Tokens& line) {
    return documented_forms(line, elsewhere);
  };
  dialect.check = [&](std::string_view text) {
    return FileReader(Source(source.name(), std::string(text))).read().diagnostics;
  };
  repair::offer_lines(source.text(), dialect, findings);
}

} // namespace

TestFile parse(const Source& source) {
  auto file = FileReader(source).read();
  if (any_error(file.diagnostics))
    offer_lines(source, file.diagnostics);
  say_lines(source.text(), file.diagnostics);
  return file;
}

std::optional<Seeds> parse_seeds(std::string_view text) {
  const auto dots = text.find("..");
  const auto first = parse_number<std::uint64_t>(text.substr(0, dots));
  const auto last =
      dots == std::string_view::npos ? first : parse_number<std::uint64_t>(text.substr(dots + 2));
  if (!first || !last || *first > *last || *last - *first == UINT64_MAX)
    return std::nullopt;
  return Seeds{*first, *last};
}

} // namespace orb::testing
