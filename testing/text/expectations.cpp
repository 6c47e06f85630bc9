#include "testing/text/file_reader.h"

#include "base/fixes.h"
#include "base/meant.h"
#include "repair/tokens.h"
#include "spec/colours.h"

namespace orb::testing {
namespace {

/// Lists what can follow `expect`; variables appear by name.
std::vector<std::string_view> expectable() {
  std::vector<std::string_view> words;
  for (const auto& row : expectations)
    if (&row != &info(Word::Variable))
      words.push_back(row.word);
  return words;
}

} // namespace

void FileReader::read_expectation(Cursor& cursor, Span span, std::uint32_t line, bool never) {
  Expectation one;
  one.never = never;
  if (cursor.at_end())
    return cursor.fail_at(span, rules::Syntax, file_texts::What(source_.text(span)),
                          file_texts::CanBeExpected(listed(expectable())));
  if (!read_whose(cursor, one))
    return;
  const auto word_span = cursor.peek_span();
  const auto word = std::string(cursor.peek());
  if (!read_what(cursor, one))
    return;
  if (never && info(one.word).never == Never::No)
    return cursor.fail_at(word_span, rules::When, file_texts::NeverNotValid(word),
                          file_texts::OnlyWithExpect(word));
  read_operands(cursor, one);
  finish(cursor, one, span, line);
}

bool FileReader::read_what(Cursor& cursor, Expectation& one) {
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

void FileReader::unknown_expectation(Cursor& cursor, std::string_view word) {
  const auto known = expectable();
  cursor.fail(rules::Word,
              word.empty() ? file_texts::MissingValue(file_texts::AnExpectation())
                           : file_texts::UnknownExpectation(word),
              meant_or(word, known, file_texts::CanBeExpected(listed(known))));
}

bool FileReader::begins_variable(Cursor& cursor) {
  auto ahead = cursor;
  const auto word = ahead.word();
  const auto equals = word.find('=');
  return equals != std::string_view::npos ? equals > 0 : ahead.peek_char() == '=';
}

void FileReader::read_operands(Cursor& cursor, Expectation& one) {
  if (one.word == Word::Error)
    return read_error(cursor, one);
  prints_ = prints_ || one.word == Word::Prints;
  std::span<const Slot> slots(info(one.word).slots);
  if (one.word == Word::Near)
    one.other_ball = ball_called(cursor.peek());
  if (one.other_ball) {
    cursor.word();
    slots = slots.subspan(1);
  }
  const auto values = cursor.read(slots);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (values[i].is_given() && (!cursor.failed() || slots[i].kind == slot::Kind::Colour))
      take(cursor, one, slots[i], values[i]);
}

void FileReader::take(Cursor& cursor, Expectation& one, const Slot& slot, const SlotValue& value) {
  if (slot.before == "by") {
    one.by = value.most;
    return;
  }
  const auto is = [&](slot::Kind kind) { return slot.kind == kind; };
  if (is(slot::Kind::Match))
    return take_match(cursor, one, value);
  if (is(slot::Kind::Colour))
    return take_color(cursor, one, value);
  if (is(slot::Kind::Place)) {
    one.x = value.least;
    one.y = value.most;
  } else if (is(slot::Kind::Zone) || is(slot::Kind::Macro) || is(slot::Kind::Variable)) {
    one.name = {value.text, value.span};
  } else {
    one.least = value.least;
    one.most = value.most;
    one.number = static_cast<int>(value.most);
    if (is(slot::Kind::Axis))
      one.side = value.text == "x" ? (value.which == 0 ? Side::AboveX : Side::BelowX)
                                   : (value.which == 0 ? Side::AboveY : Side::BelowY);
  }
}

void FileReader::take_match(Cursor& cursor, Expectation& one, const SlotValue& value) {
  one.match = static_cast<Match>(value.which);
  one.text = value.text;
  if (one.match != Match::Pattern)
    return;
  auto pattern = Pattern::compile(one.text);
  if (pattern) {
    one.pattern = std::make_shared<const Pattern>(*std::move(pattern));
    return;
  }
  const auto at = value.span.begin + 1 + static_cast<std::uint32_t>(pattern.error().at);
  cursor.fail_at({at, at + 1}, rules::Pattern, file_texts::InvalidPattern(pattern.error().message),
                 file_texts::PartOrEscape(one.text));
}

void FileReader::take_color(Cursor& cursor, Expectation& one, const SlotValue& value) {
  const auto color_of = [](std::uint32_t rgb) -> vm::Color {
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
            static_cast<std::uint8_t>(rgb)};
  };
  one.text = value.text;
  constexpr std::size_t size = 7; // including the `#`
  const bool is_hex = one.text.starts_with('#');
  const auto hex = parse_number<std::uint32_t>(std::string_view(one.text).substr(1), 16);
  if (is_hex && one.text.size() == size && hex)
    one.colors.push_back(color_of(*hex));
  // A colour name may mean what LEDC shows or what a web page shows.
  for (const auto& row : spec::led_colours)
    if (row.name == one.text && one.colors.empty())
      one.colors.push_back({row.red, row.green, row.blue});
  if (const auto rgb = structured::find_colour(one.text))
    one.colors.push_back(color_of(*rgb));
  if (!one.colors.empty())
    return;
  auto known = structured::colour_names();
  for (const auto& row : spec::led_colours)
    known.push_back(row.name);
  cursor.fail_at(value.span, rules::Value, file_texts::NotAColour(one.text),
                 is_hex ? file_texts::SixDigits()
                        : meant_or(one.text, known, file_texts::ColourIs()));
  one.text = (is_hex ? "" : "#") + repair::as_digits(one.text);
  if (auto& d = file_.diagnostics.back();
      d.span.begin == value.span.begin && one.text.size() == size &&
      parse_number<std::uint32_t>(std::string_view(one.text).substr(1), 16)) {
    d.help = file_texts::Write(one.text);
    d.fix = single_fix(d.help, value.span, one.text, Safety::Unsafe);
  }
}

void FileReader::read_error(Cursor& cursor, Expectation& one) {
  const auto from = cursor.offset();
  const auto ends = [&] {
    return cursor.at_end() || is_when(cursor.peek()) || is_join(cursor.peek()) ||
           is_times(cursor) || is_lag(cursor);
  };
  if (ends())
    return;
  std::string text;
  if (cursor.peek_char() == '"')
    text = cursor.quoted();
  else
    while (!ends())
      text += fmt::format("{}{}", text.empty() ? "" : " ", cursor.word());
  one.text = text;
  const auto span = cursor.span_from(from);
  const auto known = words_of(spec::basic_errors, &spec::BasicErrorInfo::text);
  for (const auto& row : spec::basic_errors)
    if (equal_words(row.text, text))
      one.error = row.error;
  const bool hex = text.ends_with('h');
  const auto digits = std::string_view(text).substr(0, text.size() - (hex ? 1 : 0));
  if (const auto number = parse_number<std::uint32_t>(digits, hex ? 16 : 10))
    one.error = spec::find_error(*number);
  if (one.error || cursor.failed())
    return;
  cursor.fail_at(span, rules::Value, file_texts::NotARobotError(text),
                 meant_or(text, known, file_texts::RobotErrors(listed(known))));
  if (const auto meant = closest(text, known)) {
    auto& d = file_.diagnostics.back();
    d.fix = single_fix(file_texts::Write(*meant), span, *meant, Safety::Unsafe);
  }
}

} // namespace orb::testing
