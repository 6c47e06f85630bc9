#include "testing/text/file_reader.h"

#include "spec/colours.h"

namespace orb::testing {

void FileReader::read_expectation(Cursor& cursor, Span span, std::uint32_t line, bool never) {
  Expectation one;
  one.never = never;
  if (cursor.at_end())
    return cursor.fail_at(span, rules::Syntax, fmt::format("`{}` what?", source_.text(span)),
                          fmt::format("what can be expected: {}", words_of(expectations)));
  if (!read_whose(cursor, one))
    return;
  const auto word_span = cursor.peek_span();
  const auto word = std::string(cursor.peek());
  if (!read_what(cursor, one))
    return;
  if (never && info(one.word).never == Never::No)
    return cursor.fail_at(word_span, rules::When, fmt::format("`never {}` is not valid", word),
                          fmt::format("`{}` only works with `expect`", word));
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
  std::vector<std::string_view> known;
  for (const auto& row : expectations)
    if (&row != &info(Word::Variable))
      known.push_back(row.word);
  cursor.fail(
      rules::Word, fmt::format("unknown expectation `{}`", word),
      did_you_mean(word, known, fmt::format("what can be expected: {}", fmt::join(known, ", "))));
}

bool FileReader::begins_variable(Cursor& cursor) {
  auto ahead = cursor;
  const auto word = ahead.word();
  const auto equals = word.find('=');
  return equals != std::string_view::npos ? equals > 0 : ahead.peek_char() == '=';
}

void FileReader::read_operands(Cursor& cursor, Expectation& one) {
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

void FileReader::take(Expectation& one, Cursor::Range range) {
  one.least = range.least;
  one.most = range.most;
}

void FileReader::read_print(Cursor& cursor, Expectation& one) {
  if (cursor.take('~')) {
    one.match = Match::Part;
    one.text = cursor.quoted();
    return;
  }
  if (cursor.peek_char() != '/') {
    one.text = cursor.quoted();
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
  cursor.fail_at(
      {at, at + 1}, rules::Pattern, fmt::format("invalid pattern: {}", pattern.error().message),
      fmt::format("to match part of a line as it is, write `~\"{}\"`; in a pattern, put `\\` "
                  "before a special character",
                  one.text));
}

void FileReader::read_by(Cursor& cursor, Expectation& one, std::string_view unit, double most) {
  if (!cursor.take_word("by"))
    return cursor.fail(rules::Syntax, "missing `by` and a tolerance",
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

void FileReader::read_near(Cursor& cursor, Expectation& one) {
  one.other_ball = ball_called(cursor.peek());
  if (one.other_ball) {
    cursor.word();
  } else {
    one.x = cursor.number("x");
    cursor.character(',', "a place is written `X,Y`, in centimetres");
    one.y = cursor.number("y");
  }
  if (cursor.failed())
    return;
  if (!cursor.take_word("by"))
    return cursor.fail(rules::Syntax, "missing `by` and the greatest distance",
                       "give a tolerance such as `by 12cm`");
  one.by = cursor.length();
}

void FileReader::read_beyond(Cursor& cursor, Expectation& one) {
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

void FileReader::read_name(Cursor& cursor, Expectation& one, std::string_view what) {
  const auto from = cursor.offset();
  if (cursor.at_end())
    return cursor.fail(rules::Syntax, fmt::format("missing {} name", what));
  one.name.text = cursor.peek_char() == '"' ? cursor.quoted() : std::string(cursor.word());
  one.name.span = cursor.span_from(from);
}

vm::Color FileReader::color_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

void FileReader::read_color(Cursor& cursor, Expectation& one) {
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
    auto known = structured::colour_names();
    for (const auto& row : spec::led_colours)
      known.push_back(row.name);
    return cursor.fail(rules::Value,
                       cursor.at_end() ? std::string("missing colour")
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

void FileReader::read_bad_hex(Cursor& cursor) {
  const auto span = cursor.hash_span();
  const auto text = cursor.text_of(span);
  cursor.fail_at(span, rules::Value, fmt::format("`{}` is not a colour", text),
                 "`#` is followed by six hexadecimal digits, as in `#FF8000`: red, green, blue");
}

void FileReader::read_marker(Cursor& cursor, Expectation& one) {
  one.number = static_cast<int>(cursor.whole("marker", 0, spec::ball::greatest));
  if (cursor.take_word("macro"))
    read_name(cursor, one, "macro");
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
  if (one.error || cursor.failed())
    return;
  cursor.fail_at(
      span, rules::Value, fmt::format("`{}` is not a robot error", text),
      did_you_mean(text, known, fmt::format("the errors are {}", fmt::join(known, ", "))));
  if (const auto meant = closest(text, known)) {
    auto& d = file_.diagnostics.back();
    d.fix = Fix{fmt::format("write `{}`", *meant), {{span, *meant}}, Safety::Unsafe};
  }
}

void FileReader::read_below(Cursor& cursor, Expectation& one) {
  const auto word = info(one.word).word;
  cursor.character('<', fmt::format("write it like `{} < 500`", word));
  one.most = static_cast<double>(cursor.whole(fmt::format("limit of {}", word), 1, most_times));
}

void FileReader::read_variable(Cursor& cursor, Expectation& one) {
  const auto from = cursor.offset();
  const auto word = cursor.peek();
  one.name.text = word.substr(0, word.find('='));
  one.name.span = {from, from + static_cast<std::uint32_t>(one.name.text.size())};
  cursor.skip(one.name.text.size());
  cursor.take('=');
  one.most = static_cast<double>(cursor.whole("value", INT32_MIN, INT32_MAX));
}

} // namespace orb::testing
