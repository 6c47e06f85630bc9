#include "base/duration.h"
#include "base/suggest.h"
#include "base/text.h"
#include "repair/repair.h"
#include "spec/limits.h"
#include "structured/text/words.h"
#include "testing/text/cursor.h"
#include "testing/text/rules.h"
#include "testing/text/test_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace orb::testing {
namespace {

constexpr int most_points = 1000;
constexpr std::int64_t most_times = 1'000'000'000;

template <class Row>
const Row* find_word(std::span<const Row> rows, std::string_view word) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.word == word; });
  return found == rows.end() ? nullptr : &*found;
}

/// What was written of an expectation's place in time and number.
struct Said {
  Span when{};  ///< empty: nothing
  Span times{}; ///< empty: nothing
  Span order{}; ///< empty: nothing
};

class FileReader {
public:
  explicit FileReader(const Source& source) : source_(source) {}

  TestFile read() {
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
    sort_by_place(file_.diagnostics);
    return std::move(file_);
  }

private:
  std::string_view first_word(std::uint32_t line) {
    std::vector<Diagnostic> ignored;
    return Cursor(source_, line, ignored).word();
  }

  Test new_test() const {
    Test test;
    test.seeds = seeds_.value_or(Seeds{});
    test.bound = bound_.value_or(default_bound);
    return test;
  }

  void read_line(std::uint32_t line) {
    Cursor cursor(source_, line, file_.diagnostics);
    if (cursor.at_end())
      return;
    if (prints_ && cursor.peek_char() == '"') {
      current().expectations.back().texts.push_back(cursor.quoted("line"));
      return end_of_line(cursor);
    }
    prints_ = false;
    const auto word = cursor.peek();
    const auto* row = find_word<LineInfo>(line_words, word);
    if (row == nullptr)
      return read_stimulus(cursor, word, line);
    const auto span = cursor.peek_span();
    cursor.word();
    if (row->stands == Stands::Head && has_tests_ && !file_.tests.empty())
      return cursor.fail_at(span, rules::Place, fmt::format("`{}` stands after a test", word),
                            "write it before the first `test`");
    if (row->stands == Stands::InTest && file_.tests.empty())
      return cursor.fail_at(span, rules::Place,
                            fmt::format("`{}` stands before the first test", word),
                            "write it after the `test` that it belongs to");
    read_row(static_cast<LineWord>(row - line_words.data()), cursor, span, line);
  }

  void read_row(LineWord word, Cursor& cursor, Span span, std::uint32_t line) {
    switch (word) {
    case LineWord::Program: read_file(cursor, file_.program); break;
    case LineWord::With:
      do
        read_file(cursor, file_.with.emplace_back());
      while (!cursor.at_end() && !cursor.failed());
      break;
    case LineWord::Course: read_file(cursor, file_.course); break;
    case LineWord::Target: read_target(cursor); break;
    case LineWord::Firmware: read_firmware(cursor); break;
    case LineWord::Area: read_area(cursor); break;
    case LineWord::Seeds: seeds_ = read_seeds(cursor); break;
    case LineWord::For: bound_ = read_bound(cursor); break;
    case LineWord::Test: return read_test(cursor, span, line);
    case LineWord::Expect: return read_expectation(cursor, span, line, false);
    case LineWord::Never: return read_expectation(cursor, span, line, true);
    case LineWord::Reach: return read_reach(cursor, span, line);
    }
    end_of_line(cursor);
  }

  void end_of_line(Cursor& cursor) {
    if (!cursor.failed() && !cursor.at_end())
      cursor.fail(rules::Syntax, fmt::format("`{}` is left over", cursor.peek()),
                  "a comment begins with `#`");
  }

  // Stimuli.

  void read_stimulus(Cursor& cursor, std::string_view word, std::uint32_t line) {
    const bool known = word == "at" || find_word<vm::StimulusInfo>(vm::stimulus_words, word);
    if (!known && !parse_duration(word))
      return unknown_word(cursor, word);
    const auto from = cursor.offset();
    while (!cursor.at_end())
      cursor.word();
    const auto span = cursor.span_from(from);
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

  void unknown_word(Cursor& cursor, std::string_view word) {
    std::vector<std::string_view> known;
    for (const auto& row : line_words)
      known.push_back(row.word);
    for (const auto& row : vm::stimulus_words)
      known.push_back(row.word);
    for (const auto& row : expectations)
      if (row.word == word)
        return cursor.fail(rules::Word, fmt::format("`{}` begins no line", word),
                           fmt::format("write `expect {}` or `never {}`", word, word));
    cursor.fail(
        rules::Word, fmt::format("`{}` is not a word of a test file", word),
        did_you_mean(word, known,
                     fmt::format("a line begins with {}, or with a stimulus such as `at 1s shake`",
                                 words_of(line_words))));
  }

  template <class Rows>
  static std::string words_of(const Rows& rows) {
    std::vector<std::string_view> words;
    for (const auto& row : rows)
      words.push_back(row.word);
    return fmt::format("{}", fmt::join(words, ", "));
  }

  // The head.

  void read_file(Cursor& cursor, std::optional<Named>& into) {
    const auto span = cursor.peek_span();
    if (into)
      return cursor.fail_at(span, rules::Place, "this was said before", "a test file has one");
    Named file;
    read_file(cursor, file);
    into = std::move(file);
  }

  static void read_file(Cursor& cursor, Named& into) {
    const auto from = cursor.offset();
    into.text = cursor.file_name();
    into.span = cursor.span_from(from);
  }

  void read_target(Cursor& cursor) {
    const auto found = spec::find_version(cursor.peek());
    std::vector<std::string_view> known;
    for (const auto& row : spec::basic_versions)
      known.push_back(row.text);
    if (!found)
      return cursor.fail(rules::Value, "the target is a version of orbBasic",
                         fmt::format("the versions are {}", fmt::join(known, ", ")));
    file_.target.version = *found;
    file_.target_word = cursor.word();
  }

  void read_firmware(Cursor& cursor) {
    const auto* found = spec::find_firmware(cursor.peek());
    std::vector<std::string_view> known;
    for (const auto& row : spec::firmwares)
      known.push_back(row.name);
    if (found == nullptr)
      return cursor.fail(
          rules::Value, fmt::format("`{}` is not a firmware", cursor.peek()),
          did_you_mean(cursor.peek(), known, fmt::format("there are {}", fmt::join(known, ", "))));
    file_.firmware = found->firmware;
    cursor.word();
  }

  void read_area(Cursor& cursor) {
    if (cursor.take_word("flash"))
      file_.target.area = spec::Area::Flash;
    else if (!cursor.take_word("ram"))
      cursor.fail(rules::Value, "the area is `ram` or `flash`");
  }

  static std::optional<Seeds> read_seeds(Cursor& cursor) {
    const auto found = parse_seeds(cursor.peek());
    if (!found)
      cursor.fail(rules::Value,
                  cursor.at_end() ? std::string("the seeds are missing")
                                  : fmt::format("`{}` are not seeds", cursor.peek()),
                  "write them like `1..20`");
    else if (found->count() > most_seeds)
      cursor.fail(rules::Value, fmt::format("{} seeds are too many", found->count()),
                  fmt::format("a test takes up to {}; write `{}..{}`", most_seeds, found->first,
                              found->first + most_seeds - 1));
    else {
      cursor.word();
      return found;
    }
    return std::nullopt;
  }

  static std::optional<Duration> read_bound(Cursor& cursor) {
    const auto time = cursor.time();
    if (!cursor.failed() && time == Duration{})
      cursor.fail(rules::Value, "a run of no time shows nothing", "write it like `for 30s`");
    return time == Duration{} ? std::nullopt : std::optional(time);
  }

  // Tests.

  Test& current() { return file_.tests.back(); }

  void read_test(Cursor& cursor, Span span, std::uint32_t line) {
    auto test = new_test();
    test.line = line;
    const auto from = cursor.offset();
    test.name.text = cursor.peek_char() == '"' ? cursor.quoted("name") : std::string();
    test.name.span = cursor.span_from(from);
    if (!cursor.failed() && trim(test.name.text).empty())
      cursor.fail_at(test.name.span.size() == 0 ? span : test.name.span, rules::Name,
                     "the test has no name", "write it in quotes: `test \"stops at the wall\"`");
    for (const auto& other : file_.tests)
      if (other.name.text == test.name.text && !cursor.failed())
        cursor.fail_at(test.name.span, rules::Name,
                       fmt::format("another test has the name \"{}\"", test.name.text),
                       fmt::format("it stands in line {}", other.line));
    while (!cursor.failed() && !cursor.at_end())
      read_test_option(cursor, test);
    file_.tests.push_back(std::move(test));
  }

  void read_test_option(Cursor& cursor, Test& test) {
    if (cursor.take_word("points"))
      test.points = static_cast<int>(cursor.whole("number of points", 0, most_points));
    else if (cursor.take_word("seeds"))
      test.seeds = read_seeds(cursor).value_or(test.seeds);
    else if (cursor.take_word("for"))
      test.bound = read_bound(cursor).value_or(test.bound);
    else
      cursor.fail(
          rules::Syntax, fmt::format("`{}` is left over", cursor.peek()),
          did_you_mean(cursor.peek(), std::vector<std::string_view>{"points", "seeds", "for"},
                       "after the name you can write `points N`, `seeds A..B` and `for TIME`"));
  }

  /// What only the whole file can say about a test.
  void complete(Test& test) {
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
      if ((one.when.kind == When::Kind::Within || one.when.kind == When::Kind::At ||
           one.when.kind == When::Kind::During) &&
          one.when.to > test.bound)
        file_.diagnostics.push_back(finding(
            rules::Bound, one.span, "the run is stopped before that time",
            fmt::format("a longer run is `for {}s`", (one.when.to + 999ms) / Duration{1s})));
    }
    if (speaks_of_errors)
      return;
    Expectation silent;
    silent.never = true;
    test.expectations.push_back(std::move(silent));
  }

  // Expectations.

  void read_reach(Cursor& cursor, Span span, std::uint32_t line) {
    Expectation one;
    one.word = Word::Inside;
    read_name(cursor, one, "zone");
    finish(cursor, one, span, line);
  }

  void read_expectation(Cursor& cursor, Span span, std::uint32_t line, bool never) {
    Expectation one;
    one.never = never;
    if (cursor.at_end())
      return cursor.fail_at(span, rules::Syntax, fmt::format("`{}` what?", source_.text(span)),
                            fmt::format("what can be expected: {}", words_of(expectations)));
    const auto word_span = cursor.peek_span();
    const auto word = std::string(cursor.peek());
    if (!read_what(cursor, one))
      return;
    if (never && info(one.word).never == Never::No)
      return cursor.fail_at(word_span, rules::When, fmt::format("`never {}` has no meaning", word),
                            fmt::format("`{}` takes only `expect`", word));
    read_operands(cursor, one);
    finish(cursor, one, span, line);
  }

  /// The word of what is expected; false, and a finding, where it is none.
  static bool read_what(Cursor& cursor, Expectation& one) {
    if (begins_variable(cursor)) {
      one.word = Word::Variable;
      return true;
    }
    const auto word = std::string(cursor.peek());
    const auto* row = find_word<ExpectationInfo>(expectations, word);
    if (word == info(LineWord::Reach).word)
      row = &info(Word::Inside);
    if (row == nullptr || row == &info(Word::Variable)) {
      unknown_expectation(cursor, word);
      return false;
    }
    one.word = static_cast<Word>(row - expectations.data());
    cursor.word();
    return true;
  }

  static void unknown_expectation(Cursor& cursor, std::string_view word) {
    std::vector<std::string_view> known;
    for (const auto& row : expectations)
      if (&row != &info(Word::Variable))
        known.push_back(row.word);
    cursor.fail(
        rules::Word, fmt::format("`{}` cannot be expected", word),
        did_you_mean(word, known, fmt::format("what can be expected: {}", fmt::join(known, ", "))));
  }

  /// Whether `NAME =` stands here; the cursor stays where it is.
  static bool begins_variable(Cursor& cursor) {
    auto ahead = cursor;
    const auto word = ahead.word();
    const auto equals = word.find('=');
    return equals != std::string_view::npos ? equals > 0 : ahead.peek_char() == '=';
  }

  void read_operands(Cursor& cursor, Expectation& one) {
    switch (one.word) {
    case Word::Print: return read_print(cursor, one);
    case Word::Prints: prints_ = true; return;
    case Word::Near: return read_near(cursor, one);
    case Word::Beyond: return read_beyond(cursor, one);
    case Word::Inside:
    case Word::Stay: return read_name(cursor, one, "zone");
    case Word::Heading:
      one.most = static_cast<double>(cursor.whole("heading", 0, spec::ball::full_circle - 1));
      read_by(cursor, one, "deg", spec::ball::full_circle / 2);
      return;
    case Word::Speed: return take(one, cursor.speeds());
    case Word::Moving:
    case Word::Resting:
    case Word::Collision:
    case Word::Asleep:
    case Word::End: return;
    case Word::Distance: return take(one, cursor.lengths());
    case Word::Color: return read_color(cursor, one);
    case Word::BackLed: return take(one, cursor.numbers("brightness", 0, spec::ball::greatest));
    case Word::Marker: return read_marker(cursor, one);
    case Word::Error: return read_error(cursor, one);
    case Word::Lines:
    case Word::Bytes: return read_below(cursor, one);
    case Word::Variable: return read_variable(cursor, one);
    }
  }

  static void take(Expectation& one, Cursor::Range range) {
    one.least = range.least;
    one.most = range.most;
  }

  void read_print(Cursor& cursor, Expectation& one) {
    if (cursor.take('~')) {
      one.match = Match::Part;
      one.text = cursor.quoted("part of a line");
      return;
    }
    if (cursor.peek_char() != '/') {
      one.text = cursor.quoted("line");
      return;
    }
    one.match = Match::Pattern;
    const auto from = cursor.offset();
    one.text = cursor.slashed();
    if (cursor.failed())
      return;
    auto pattern = Pattern::compile(one.text);
    if (pattern) {
      one.pattern = std::make_shared<const Pattern>(*std::move(pattern));
      return;
    }
    const auto at = from + 1 + static_cast<std::uint32_t>(pattern.error().at);
    cursor.fail_at({at, at + 1}, rules::Pattern,
                   fmt::format("the pattern cannot be read: {}", pattern.error().message));
  }

  static void read_by(Cursor& cursor, Expectation& one, std::string_view unit, double most) {
    if (!cursor.take_word("by"))
      return cursor.fail(rules::Syntax, "`by` is missing: how exact it must be",
                         fmt::format("write it like `by {}`", unit == "deg" ? "5" : "12cm"));
    const auto span = cursor.peek_span();
    auto text = cursor.peek();
    if (text.ends_with(unit))
      text.remove_suffix(unit.size());
    const auto value = parse_number<double>(text, std::chars_format::fixed);
    if (!value || *value < 0 || *value > most)
      return cursor.fail_at(span, rules::Value, fmt::format("`by` takes 0 to {}", most));
    one.by = *value;
    cursor.word();
  }

  static void read_near(Cursor& cursor, Expectation& one) {
    one.x = cursor.number("x");
    cursor.character(',', "a place is `X,Y`, in centimetres");
    one.y = cursor.number("y");
    if (cursor.failed())
      return;
    if (!cursor.take_word("by"))
      return cursor.fail(rules::Syntax, "`by` is missing: how far away the ball may be",
                         "a ball is not a measuring instrument: write it like `by 12cm`");
    one.by = cursor.length();
  }

  static void read_beyond(Cursor& cursor, Expectation& one) {
    const bool is_x = cursor.take('x');
    if (!is_x && !cursor.take('y'))
      return cursor.fail(rules::Value, "`beyond` takes a line such as `x>70` or `y<-20`");
    const bool above = cursor.take('>');
    if (!above && !cursor.take('<'))
      return cursor.fail(rules::Value, "`beyond` takes `>` or `<` after the axis",
                         "write it like `x>70` or `y<-20`");
    one.side = is_x ? (above ? Side::AboveX : Side::BelowX) : (above ? Side::AboveY : Side::BelowY);
    one.most = cursor.number("place of the line");
    cursor.take_word("cm");
  }

  static void read_name(Cursor& cursor, Expectation& one, std::string_view what) {
    const auto from = cursor.offset();
    if (cursor.at_end())
      return cursor.fail(rules::Syntax, fmt::format("the name of the {} is missing", what));
    one.name.text = cursor.peek_char() == '"' ? cursor.quoted("name") : std::string(cursor.word());
    one.name.span = cursor.span_from(from);
  }

  static vm::Color color_of(std::uint32_t rgb) {
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
            static_cast<std::uint8_t>(rgb)};
  }

  void read_color(Cursor& cursor, Expectation& one) {
    one.text = std::string(cursor.color_word());
    if (one.text.starts_with('#')) {
      const auto rgb = parse_number<std::uint32_t>(std::string_view(one.text).substr(1), 16);
      one.colors.push_back(color_of(rgb.value_or(0)));
    } else {
      // A word may mean what LEDC shows or what a web page does.
      for (const auto& row : spec::led_colours)
        if (row.name == one.text && one.colors.empty())
          one.colors.push_back({row.red, row.green, row.blue});
      if (const auto rgb = structured::find_colour(one.text))
        one.colors.push_back(color_of(*rgb));
    }
    if (one.colors.empty() && cursor.hash_span().size() > 1)
      return read_bad_hex(cursor);
    if (one.colors.empty()) {
      std::vector<std::string_view> known;
      for (const auto& row : spec::led_colours)
        known.push_back(row.name);
      for (const auto* name : {"silver", "gray", "maroon", "fuchsia", "lime", "olive", "navy",
                               "teal", "aqua", "black"})
        known.emplace_back(name);
      return cursor.fail(rules::Value,
                         cursor.at_end() ? std::string("the colour is missing")
                                         : fmt::format("`{}` is not a colour", one.text),
                         did_you_mean(one.text, known,
                                      "a colour is a name such as `red`, `#RRGGBB` or "
                                      "`off`"));
    }
    cursor.skip(one.text.size());
    auto ahead = cursor;
    ahead.word();
    if (!parse_duration(ahead.word()) && cursor.take_word("by")) // `by 200ms` is of `after`
      one.by = static_cast<double>(cursor.whole("difference", 0, spec::ball::greatest));
  }

  /// `#` without six digits: a comment may follow a colour, but here the colour itself is missing.
  static void read_bad_hex(Cursor& cursor) {
    const auto span = cursor.hash_span();
    const auto text = cursor.text_of(span);
    cursor.fail_at(span, rules::Value, fmt::format("`{}` is not a colour", text),
                   "after `#` stand six hexadecimal digits, as in `#FF8000`: red, green, blue");
  }

  static void read_marker(Cursor& cursor, Expectation& one) {
    one.number = static_cast<int>(cursor.whole("marker", 0, spec::ball::greatest));
    if (cursor.take_word("macro"))
      read_name(cursor, one, "macro");
  }

  void read_error(Cursor& cursor, Expectation& one) {
    const auto from = cursor.offset();
    const auto ends = [&] {
      return cursor.at_end() || is_when(cursor.peek()) || is_join(cursor.peek()) ||
             is_times(cursor) || is_lag(cursor);
    };
    if (ends())
      return;
    std::string text;
    if (cursor.peek_char() == '"')
      text = cursor.quoted("name of the error");
    else
      while (!ends())
        text += fmt::format("{}{}", text.empty() ? "" : " ", cursor.word());
    one.text = text;
    const auto span = cursor.span_from(from);
    std::vector<std::string_view> known;
    for (const auto& row : spec::basic_errors) {
      known.push_back(row.text);
      if (equal_words(row.text, text))
        one.error = row.error;
    }
    const bool hex = text.ends_with('h');
    const auto digits = std::string_view(text).substr(0, text.size() - (hex ? 1 : 0));
    if (const auto number = parse_number<std::uint32_t>(digits, hex ? 16 : 10))
      one.error = spec::find_error(*number);
    if (!one.error && !cursor.failed())
      cursor.fail_at(
          span, rules::Value, fmt::format("`{}` is not an error of the robot", text),
          did_you_mean(text, known, fmt::format("the errors are {}", fmt::join(known, ", "))));
  }

  static void read_below(Cursor& cursor, Expectation& one) {
    const auto word = info(one.word).word;
    cursor.character('<', fmt::format("write it like `{} < 500`", word));
    one.most = static_cast<double>(cursor.whole(fmt::format("limit of {}", word), 1, most_times));
  }

  static void read_variable(Cursor& cursor, Expectation& one) {
    const auto from = cursor.offset();
    const auto word = cursor.peek();
    one.name.text = word.substr(0, word.find('='));
    one.name.span = {from, from + static_cast<std::uint32_t>(one.name.text.size())};
    cursor.skip(one.name.text.size());
    cursor.take('=');
    one.most = static_cast<double>(cursor.whole("value", INT32_MIN, INT32_MAX));
  }

  // How often and when.

  static bool is_when(std::string_view word) {
    return find_word<WordInfo>(when_words, word) != nullptr;
  }

  static bool is_join(std::string_view word) {
    return find_word<WordInfo>(join_words, word) != nullptr;
  }

  /// Whether `TIME after` stands here.
  static bool is_lag(Cursor& cursor) {
    auto ahead = cursor;
    return parse_duration(ahead.word()) && ahead.peek() == info(JoinWord::After).word;
  }

  /// Whether `N times` or `A to B times` stands here.
  static bool is_times(Cursor& cursor) {
    auto ahead = cursor;
    if (!parse_number<std::uint64_t>(ahead.word()))
      return false;
    return ahead.peek() == "times" || ahead.peek() == "to";
  }

  void read_times(Cursor& cursor, Expectation& one, Said& said) {
    const auto from = cursor.offset();
    one.times.least = static_cast<std::uint64_t>(cursor.whole("count", 0, most_times));
    one.times.most = one.times.least;
    if (cursor.take_word("to"))
      one.times.most = static_cast<std::uint64_t>(cursor.whole("count", 0, most_times));
    if (!cursor.failed() && !cursor.take_word("times"))
      return cursor.fail(rules::Syntax, "`times` is missing", "write it like `1 to 6 times`");
    said.times = cursor.span_from(from);
    if (one.times.most < one.times.least)
      cursor.fail_at(said.times, rules::Value, "the count runs backwards",
                     "write the smaller value first");
  }

  void read_when(Cursor& cursor, Expectation& one, Said& said) {
    using Kind = When::Kind;
    const auto from = cursor.offset();
    if (cursor.take_word("within"))
      one.when = {Kind::Within, {}, cursor.time()};
    else if (cursor.take_word("during")) {
      const auto [begin, end] = cursor.times();
      one.when = {Kind::During, begin, end};
    } else {
      cursor.take_word("at");
      if (cursor.take_word("end"))
        one.when = {Kind::AtEnd, {}, {}};
      else
        one.when = {Kind::At, {}, cursor.time()};
    }
    said.when = cursor.span_from(from);
  }

  /// `and STATE`.
  void read_joined(Cursor& cursor, Expectation& one, const Said& said) {
    const auto span = cursor.peek_span();
    cursor.word();
    if (said.when.size() > 0 || one.lasts > Duration{})
      return cursor.fail_at(span, rules::Syntax, "`and` stands after a time",
                            "write all that is joined first, then `for` and the time");
    if (info(one.word).kind != Kind::State && info(one.word).kind != Kind::Event)
      return cursor.fail_at(span, rules::When,
                            fmt::format("`{}` cannot be joined", info(one.word).word),
                            "write it into a line of its own");
    Expectation state;
    const auto word_span = cursor.peek_span();
    if (!read_what(cursor, state))
      return;
    if (info(state.word).kind != Kind::State)
      return cursor.fail_at(word_span, rules::When,
                            fmt::format("`{}` is not a state", info(state.word).word),
                            "after `and` stands what is true at a moment, such as `color red` or "
                            "`resting`; what happens stands before it");
    read_operands(cursor, state);
    one.joined.push_back(std::move(state));
  }

  /// `for TIME`.
  static void read_lasts(Cursor& cursor, Expectation& one) {
    const auto from = cursor.offset();
    cursor.word();
    const auto time = cursor.time();
    if (cursor.failed())
      return;
    const auto span = cursor.span_from(from);
    const auto& row = info(one.word);
    if (row.kind != Kind::State)
      return cursor.fail_at(span, rules::When, fmt::format("`{}` does not last", row.word),
                            "leave `for` and its time out");
    if (one.lasts > Duration{} || time == Duration{})
      return cursor.fail_at(span, rules::Value, "`for` takes one time, longer than none",
                            "write it like `for 2s`");
    one.lasts = time;
  }

  /// `after WHAT` and `before WHAT`.
  void read_order(Cursor& cursor, Expectation& one, Said& said) {
    const auto from = cursor.offset();
    const bool is_after = cursor.word() == info(JoinWord::After).word;
    one.order = is_after ? Order::After : Order::Before;
    Expectation other;
    if (cursor.at_end())
      return cursor.fail(
          rules::Syntax, fmt::format("`{}` what?", is_after ? "after" : "before"),
          "write what happens, or a state: `print \"2\"`, `color red`, `reach goal`");
    const auto word_span = cursor.peek_span();
    if (!read_what(cursor, other))
      return;
    if (const auto& row = info(other.word); row.kind != Kind::State && row.kind != Kind::Event)
      return cursor.fail_at(
          word_span, rules::When, fmt::format("nothing comes after or before `{}`", row.word),
          "write what happens, or a state: `print \"2\"`, `color red`, `reach goal`");
    read_operands(cursor, other);
    while (!cursor.failed() && cursor.peek() == info(JoinWord::And).word)
      read_joined(cursor, other, {});
    if (!cursor.failed() && cursor.peek() == info(JoinWord::Lasts).word)
      read_lasts(cursor, other);
    if (!cursor.failed() && is_when(cursor.peek()))
      return cursor.fail(rules::When, "the time stands at the wrong place",
                         is_after ? "write it before `after`; it counts from there"
                                  : "`before` takes no time; write that into a line of its own");
    if (!cursor.failed() && one.lag) {
      if (!cursor.take_word("by"))
        return cursor.fail(rules::Syntax, "`by` is missing: how exact the time must be",
                           "write it like `by 200ms`");
      one.lag_by = cursor.time();
    }
    said.order = cursor.span_from(from);
    one.other = std::make_shared<const Expectation>(std::move(other));
  }

  void finish(Cursor& cursor, Expectation& one, Span span, std::uint32_t line) {
    Said said;
    while (!cursor.failed() && !cursor.at_end()) {
      const auto word = cursor.peek();
      if (said.order.size() > 0)
        left_over(cursor, one);
      else if (is_when(word) && said.when.size() == 0)
        read_when(cursor, one, said);
      else if (is_digit(cursor.peek_char()) && said.times.size() == 0 && is_times(cursor))
        read_times(cursor, one, said);
      else if (word == info(JoinWord::And).word)
        read_joined(cursor, one, said);
      else if (word == info(JoinWord::Lasts).word)
        read_lasts(cursor, one);
      else if (word == info(JoinWord::After).word || word == info(JoinWord::Before).word)
        read_order(cursor, one, said);
      else if (is_lag(cursor) && said.when.size() == 0)
        one.lag = cursor.time();
      else
        left_over(cursor, one);
    }
    one.line = line;
    one.span = cursor.span_from(span.begin);
    check_when(cursor, one, said, span);
    check_order(cursor, one, said);
    if (cursor.failed())
      prints_ = false;
    else
      current().expectations.push_back(std::move(one));
  }

  /// Whether `after` and `before` fit the rest.
  static void check_order(Cursor& cursor, const Expectation& one, const Said& said) {
    if (one.order == Order::Free)
      return;
    const auto& row = info(one.word);
    if (row.kind != Kind::State && row.kind != Kind::Event)
      return cursor.fail_at(said.order, rules::When,
                            fmt::format("`{}` comes neither after nor before something", row.word),
                            "leave that out");
    if (one.order == Order::Before && said.when.size() > 0)
      return cursor.fail_at(said.when, rules::When, "`before` takes no time",
                            "write that into a line of its own");
    if (one.lag && (one.never || said.when.size() > 0 || one.order == Order::Before))
      cursor.fail_at(said.order, rules::When, "an exact time after something is expected alone",
                     "write it like `expect print \"3\" 1s after print \"2\" by 200ms`");
  }

  static void left_over(Cursor& cursor, const Expectation& one) {
    std::vector<std::string_view> known{"times"};
    for (const auto& row : when_words)
      known.push_back(row.word);
    for (const auto& row : join_words)
      known.push_back(row.word);
    const auto& row = info(one.word);
    cursor.fail(rules::Syntax, fmt::format("`{}` is left over", cursor.peek()),
                did_you_mean(cursor.peek(), known,
                             row.operands.empty()
                                 ? fmt::format("`{}` stands alone, or with a time", row.word)
                                 : fmt::format("it is written `{} {}`", row.word, row.operands)));
  }

  /// Whether what was said of time fits the word.
  static void check_when(Cursor& cursor, const Expectation& one, const Said& said, Span first) {
    using Of = When::Kind;
    const auto& row = info(one.word);
    const auto wrong = [&](Span span, std::string message, std::string help) {
      cursor.fail_at(span, rules::When, std::move(message), std::move(help));
    };
    const auto when = one.when.kind;
    if (said.times.size() > 0 && row.kind != Kind::Event)
      return wrong(said.times, fmt::format("`{}` does not happen a number of times", row.word),
                   "leave the count out");
    if (one.never && said.times.size() > 0)
      return wrong(said.times, "`never` takes no count",
                   "write `expect … 0 times`, or leave it out");
    if (one.never && when == Of::Within)
      return wrong(said.when, "`never` speaks of the whole run, `within` of some moment",
                   "for a part of the run write `during 0s..10s`");
    switch (row.kind) {
    case Kind::State: return;
    case Kind::Stay:
      if (when != Of::AnyTime && when != Of::During)
        wrong(said.when, "`stay` speaks of every moment",
              "leave the time out, or write `during 2s..3s`; for one moment write `inside`");
      return;
    case Kind::Event:
      if (when == Of::At || when == Of::AtEnd)
        wrong(said.when, fmt::format("`{}` happens; it is not true at one moment", row.word),
              "write `within 3s` or `during 2s..3s`");
      return;
    case Kind::Output:
      if (when != Of::AnyTime)
        wrong(said.when, "`prints` speaks of all that is printed", "leave the time out");
      return;
    case Kind::End:
      if (when != Of::Within)
        wrong(said.when.size() > 0 ? said.when : first, "`end` needs `within`",
              "write it like `expect end within 10s`");
      return;
    case Kind::Final:
      if (when != Of::AtEnd && when != Of::AnyTime)
        wrong(said.when, fmt::format("`{}` is known when the run is over", row.word),
              "leave the time out, or write `at end`");
      else if (one.word == Word::Variable && when != Of::AtEnd)
        wrong(one.name.span, "the value of a variable is known at the end",
              "write `at end` after it");
      return;
    }
  }

  const Source& source_;
  TestFile file_;
  bool has_tests_ = false;
  bool prints_ = false; ///< the last expectation is `prints`, and its lines may follow
  std::optional<Seeds> seeds_;
  std::optional<Duration> bound_;
  std::vector<vm::TimedStimulus> head_; ///< the stimuli of every test
  std::vector<std::string> head_lines_;
};

std::vector<std::string_view> all_words() {
  std::vector<std::string_view> words{"at", "by", "times", "to", "points", "macro", "end"};
  for (const auto& row : line_words)
    words.push_back(row.word);
  for (const auto& row : expectations)
    words.push_back(row.word);
  for (const auto& row : when_words)
    words.push_back(row.word);
  for (const auto& row : join_words)
    words.push_back(row.word);
  for (const auto& row : vm::stimulus_words)
    words.push_back(row.word);
  const auto colours = structured::colour_names();
  words.insert(words.end(), colours.begin(), colours.end());
  return words;
}

/// The line to write, for each error.
void offer_lines(const Source& source, std::vector<Diagnostic>& findings) {
  repair::Judge judge;
  judge.language = repair::Language::Test;
  judge.words = all_words();
  judge.parses = [](std::string_view line) {
    return FileReader(Source({}, "test \"x\"\n" + std::string(line))).read().diagnostics.empty() ||
           FileReader(Source({}, std::string(line))).read().diagnostics.empty();
  };
  judge.check = [&](std::string_view text) {
    return FileReader(Source(source.name(), std::string(text))).read().diagnostics;
  };
  repair::offer_lines(source.text(), judge, findings);
}

} // namespace

TestFile parse(const Source& source) {
  auto file = FileReader(source).read();
  if (any_error(file.diagnostics))
    offer_lines(source, file.diagnostics);
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
