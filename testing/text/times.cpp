#include "testing/text/file_reader.h"

namespace orb::testing {

bool FileReader::is_when(std::string_view word) {
  return find_word<WordInfo>(when_words, word) != nullptr;
}

bool FileReader::is_join(std::string_view word) {
  return find_word<WordInfo>(join_words, word) != nullptr;
}

bool FileReader::is_lag(Cursor& cursor) {
  auto ahead = cursor;
  return parse_duration(ahead.word()) && ahead.peek() == info(JoinWord::After).word;
}

bool FileReader::is_times(Cursor& cursor) {
  auto ahead = cursor;
  if (!parse_number<std::uint64_t>(ahead.word()))
    return false;
  return ahead.peek() == "times" || ahead.peek() == "to";
}

void FileReader::read_times(Cursor& cursor, Expectation& one, Said& said) {
  const auto from = cursor.offset();
  one.times.least = static_cast<std::uint64_t>(cursor.whole("count", 0, most_times));
  one.times.most = one.times.least;
  if (cursor.take_word("to"))
    one.times.most = static_cast<std::uint64_t>(cursor.whole("count", 0, most_times));
  if (!cursor.failed() && !cursor.take_word("times"))
    return cursor.fail(rules::Syntax, "missing `times`", "write it like `1 to 6 times`");
  said.times = cursor.span_from(from);
  if (one.times.most < one.times.least)
    cursor.fail_at(said.times, rules::Value, "the count is reversed",
                   "write the smaller value first");
}

void FileReader::read_when(Cursor& cursor, Expectation& one, Said& said) {
  const auto from = cursor.offset();
  if (cursor.take_word("within"))
    one.when = {When::Kind::Within, {}, cursor.time()};
  else if (cursor.take_word("during")) {
    const auto [begin, end] = cursor.times();
    one.when = {When::Kind::During, begin, end};
  } else {
    cursor.take_word("at");
    if (cursor.take_word("end"))
      one.when = {When::Kind::AtEnd, {}, {}};
    else
      one.when = {When::Kind::At, {}, cursor.time()};
  }
  said.when = cursor.span_from(from);
}

void FileReader::read_joined(Cursor& cursor, Expectation& one, const Said& said) {
  const auto span = cursor.peek_span();
  cursor.word();
  if (said.when.size() > 0 || one.lasts > Duration{})
    return cursor.fail_at(span, rules::Syntax, "`and` after a time",
                          "write everything joined by `and` first, then `for` and the time");
  if (info(one.word).kind != Kind::State && info(one.word).kind != Kind::Event)
    return cursor.fail_at(span, rules::When,
                          fmt::format("`{}` cannot be joined", info(one.word).word),
                          "write it on a separate line");
  Expectation state;
  const auto word_span = cursor.peek_span();
  if (!read_what(cursor, state))
    return;
  if (info(state.word).kind != Kind::State)
    return cursor.fail_at(
        word_span, rules::When, fmt::format("`{}` is not a state", info(state.word).word),
        "`and` must be followed by a state, such as `color red` or `resting`; events go before it");
  read_operands(cursor, state);
  one.joined.push_back(std::move(state));
}

void FileReader::read_lasts(Cursor& cursor, Expectation& one) {
  const auto from = cursor.offset();
  cursor.word();
  const auto time = cursor.time();
  if (cursor.failed())
    return;
  const auto span = cursor.span_from(from);
  const auto& row = info(one.word);
  if (row.kind != Kind::State)
    return cursor.fail_at(span, rules::When,
                          fmt::format("`{}` is an event and has no duration", row.word),
                          "remove `for` and its time");
  if (one.lasts > Duration{} || time == Duration{})
    return cursor.fail_at(span, rules::Value, "`for` takes a single time, greater than 0",
                          "write it like `for 2s`");
  one.lasts = time;
}

void FileReader::read_order(Cursor& cursor, Expectation& one, Said& said) {
  const auto from = cursor.offset();
  const bool is_after = cursor.word() == info(JoinWord::After).word;
  one.order = is_after ? Order::After : Order::Before;
  Expectation other;
  if (cursor.at_end())
    return cursor.fail(rules::Syntax, fmt::format("`{}` what?", is_after ? "after" : "before"),
                       "write what happens, or a state: `print \"2\"`, `color red`, `reach goal`");
  const auto word_span = cursor.peek_span();
  if (!read_what(cursor, other))
    return;
  if (const auto& row = info(other.word); row.kind != Kind::State && row.kind != Kind::Event)
    return cursor.fail_at(
        word_span, rules::When, fmt::format("missing event after `{}`", row.word),
        "write what happens, or a state: `print \"2\"`, `color red`, `reach goal`");
  read_operands(cursor, other);
  while (!cursor.failed() && cursor.peek() == info(JoinWord::And).word)
    read_joined(cursor, other, {});
  if (!cursor.failed() && cursor.peek() == info(JoinWord::Lasts).word)
    read_lasts(cursor, other);
  if (!cursor.failed() && is_when(cursor.peek()))
    return cursor.fail(rules::When, "misplaced time",
                       is_after ? "write it before `after`; it is counted from there"
                                : "`before` takes no time; write that on a separate line");
  if (!cursor.failed() && one.lag) {
    if (!cursor.take_word("by"))
      return cursor.fail(rules::Syntax, "missing `by` and a tolerance for the time",
                         "write it like `by 200ms`");
    one.lag_by = cursor.time();
  }
  said.order = cursor.span_from(from);
  one.other = std::make_shared<const Expectation>(std::move(other));
}

void FileReader::finish(Cursor& cursor, Expectation& one, Span span, std::uint32_t line) {
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

void FileReader::check_order(Cursor& cursor, const Expectation& one, const Said& said) {
  if (one.order == Order::Free)
    return;
  const auto& row = info(one.word);
  if (row.kind != Kind::State && row.kind != Kind::Event)
    return cursor.fail_at(said.order, rules::When,
                          fmt::format("`{}` takes no `after` or `before`", row.word),
                          "remove that");
  if (one.order == Order::Before && said.when.size() > 0)
    return cursor.fail_at(said.when, rules::When, "`before` takes no time",
                          "write that on a separate line");
  if (one.lag && (one.never || said.when.size() > 0 || one.order == Order::Before))
    cursor.fail_at(said.order, rules::When,
                   "an exact time cannot be combined with `never`, `before` or another time",
                   "write it like `expect print \"3\" 1s after print \"2\" by 200ms`");
}

void FileReader::left_over(Cursor& cursor, const Expectation& one) {
  std::vector<std::string_view> known{"times"};
  for (const auto& row : when_words)
    known.push_back(row.word);
  for (const auto& row : join_words)
    known.push_back(row.word);
  const auto& row = info(one.word);
  cursor.fail(rules::Syntax, fmt::format("unexpected `{}`", cursor.peek()),
              did_you_mean(cursor.peek(), known,
                           row.operands.empty()
                               ? fmt::format("`{}` is used alone or with a time", row.word)
                               : fmt::format("write `{} {}`", row.word, row.operands)));
}

void FileReader::check_when(Cursor& cursor, const Expectation& one, const Said& said, Span first) {
  using Of = When::Kind;
  const auto& row = info(one.word);
  const auto wrong = [&](Span span, std::string message, std::string help) {
    cursor.fail_at(span, rules::When, std::move(message), std::move(help));
  };
  const auto when = one.when.kind;
  if (said.times.size() > 0 && row.kind != Kind::Event)
    return wrong(said.times, fmt::format("`{}` cannot be counted", row.word), "remove the count");
  if (one.never && said.times.size() > 0)
    return wrong(said.times, "`never` takes no count", "write `expect … 0 times`, or remove it");
  if (one.never && when == Of::Within)
    return wrong(said.when, "`never` covers the whole run, but `within` covers a single moment",
                 "for a part of the run write `during 0s..10s`");
  switch (row.kind) {
  case Kind::State: return;
  case Kind::Stay:
    if (when != Of::AnyTime && when != Of::During)
      wrong(said.when, "`stay` covers every moment",
            "remove the time, or write `during 2s..3s`; for one moment write `inside`");
    return;
  case Kind::Event:
    if (when == Of::At || when == Of::AtEnd)
      wrong(said.when, fmt::format("`{}` is an event, not a state", row.word),
            "write `within 3s` or `during 2s..3s`");
    return;
  case Kind::Output:
    if (when != Of::AnyTime)
      wrong(said.when, "`prints` covers everything that is printed", "remove the time");
    return;
  case Kind::End:
    if (when != Of::Within)
      wrong(said.when.size() > 0 ? said.when : first, "`end` needs `within`",
            "write it like `expect end within 10s`");
    return;
  case Kind::Final:
    if (when != Of::AtEnd && when != Of::AnyTime)
      wrong(said.when, fmt::format("`{}` is only known at the end of the run", row.word),
            "remove the time, or write `at end`");
    else if (one.word == Word::Variable && when != Of::AtEnd)
      wrong(one.name.span, "a variable is only known at the end of the run", "add `at end`");
    return;
  }
}

} // namespace orb::testing
