#include "testing/text/file_reader.h"

#include "base/meant.h"

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

void FileReader::read_times(Cursor& cursor, Expectation& one, GivenSpans& said) {
  const auto from = cursor.offset();
  const auto count = [&] { return static_cast<std::uint64_t>(cursor.read(slot::count).most); };
  one.times.least = one.times.most = count();
  if (cursor.take_word("to"))
    one.times.most = count();
  if (!cursor.failed() && !cursor.take_word("times"))
    return cursor.fail(rules::Syntax, file_texts::Missing("times"),
                       file_texts::WriteLike("1 to 6 times"));
  said.times = cursor.span_from(from);
  if (one.times.most < one.times.least)
    cursor.fail_at(said.times, rules::Value, file_texts::Reversed(file_texts::Count()),
                   file_texts::SmallerFirst());
}

void FileReader::read_when(Cursor& cursor, Expectation& one, GivenSpans& said) {
  const auto from = cursor.offset();
  const auto* const row = find_word<WordInfo>(when_words, cursor.word());
  const auto value = cursor.read(row->slots[0]);
  one.when = {row == &info(WhenWord::Within)   ? When::Kind::Within
              : row == &info(WhenWord::During) ? When::Kind::During
              : value.which == 1               ? When::Kind::AtEnd
                                               : When::Kind::At,
              value.from, value.to};
  said.when = cursor.span_from(from);
}

void FileReader::read_joined(Cursor& cursor, Expectation& one, const GivenSpans& said) {
  const auto span = cursor.peek_span();
  cursor.word();
  if (said.when.size() > 0 || one.lasts > Duration{})
    return cursor.fail_at(span, rules::Syntax, file_texts::AndAfterTime(), file_texts::JoinFirst());
  if (info(one.word).kind != Kind::State && info(one.word).kind != Kind::Event)
    return cursor.fail_at(span, rules::When, file_texts::CannotBeJoined(info(one.word).word),
                          file_texts::OnSeparateLine());
  Expectation state;
  const auto word_span = cursor.peek_span();
  if (!read_what(cursor, state))
    return;
  if (info(state.word).kind != Kind::State)
    return cursor.fail_at(word_span, rules::When, file_texts::NotAState(info(state.word).word),
                          file_texts::JoinsStates());
  read_operands(cursor, state);
  one.joined.push_back(std::move(state));
}

void FileReader::read_lasts(Cursor& cursor, Expectation& one) {
  const auto from = cursor.offset();
  cursor.word();
  const auto time = cursor.read(info(JoinWord::Lasts).slots[0]).to;
  if (cursor.failed())
    return;
  const auto span = cursor.span_from(from);
  const auto& row = info(one.word);
  if (row.kind != Kind::State)
    return cursor.fail_at(span, rules::When, file_texts::NoDuration(row.word),
                          file_texts::RemoveLasts());
  if (one.lasts > Duration{} || time == Duration{})
    return cursor.fail_at(span, rules::Value, file_texts::LastsOneTime(),
                          file_texts::WriteLike("for 2s"));
  one.lasts = time;
}

void FileReader::read_order(Cursor& cursor, Expectation& one, GivenSpans& said) {
  const auto from = cursor.offset();
  const bool is_after = cursor.word() == info(JoinWord::After).word;
  one.order = is_after ? Order::After : Order::Before;
  Expectation other;
  if (cursor.at_end())
    return cursor.fail(rules::Syntax, file_texts::What(is_after ? "after" : "before"),
                       file_texts::WhatHappens());
  const auto word_span = cursor.peek_span();
  if (!read_what(cursor, other))
    return;
  if (const auto& row = info(other.word); row.kind != Kind::State && row.kind != Kind::Event)
    return cursor.fail_at(word_span, rules::When, file_texts::NeitherEventNorState(row.word),
                          file_texts::WhatHappens());
  read_operands(cursor, other);
  while (!cursor.failed() && cursor.peek() == info(JoinWord::And).word)
    read_joined(cursor, other, {});
  if (!cursor.failed() && cursor.peek() == info(JoinWord::Lasts).word)
    read_lasts(cursor, other);
  if (!cursor.failed() && is_when(cursor.peek()))
    return cursor.fail(rules::When, file_texts::MisplacedTime(),
                       is_after ? file_texts::TimeBeforeAfter()
                                : file_texts::BeforeTakesNoTimeHere());
  if (!cursor.failed() && one.lag)
    one.lag_by = cursor.read(slot::lag_by).to;
  said.order = cursor.span_from(from);
  one.other = std::make_shared<const Expectation>(std::move(other));
}

void FileReader::finish(Cursor& cursor, Expectation& one, Span span, std::uint32_t line) {
  GivenSpans said;
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
      one.lag = cursor.read(slot::time).to;
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

void FileReader::check_order(Cursor& cursor, const Expectation& one, const GivenSpans& said) {
  if (one.order == Order::Free)
    return;
  const auto& row = info(one.word);
  if (row.kind != Kind::State && row.kind != Kind::Event)
    return cursor.fail_at(said.order, rules::When, file_texts::TakesNoOrder(row.word),
                          file_texts::RemoveThat());
  if (one.order == Order::Before && said.when.size() > 0)
    return cursor.fail_at(said.when, rules::When, file_texts::BeforeTakesNoTime(),
                          file_texts::ThatOnSeparateLine());
  if (one.lag && (one.never || said.when.size() > 0 || one.order == Order::Before))
    cursor.fail_at(said.order, rules::When, file_texts::ExactTimeAlone(),
                   file_texts::WriteLike("expect print \"3\" 1s after print \"2\" by 200ms"));
}

void FileReader::left_over(Cursor& cursor, const Expectation& one) {
  std::vector<std::string_view> known{"times"};
  for (const auto& row : when_words)
    known.push_back(row.word);
  for (const auto& row : join_words)
    known.push_back(row.word);
  const auto& row = info(one.word);
  cursor.fail(rules::Syntax, file_texts::Unexpected(cursor.peek()),
              meant_or(cursor.peek(), known,
                       row.slots.empty() ? file_texts::UsedAlone(row.word)
                                         : file_texts::WriteLike(usage(row.word, row.slots))));
}

void FileReader::check_when(Cursor& cursor, const Expectation& one, const GivenSpans& said,
                            Span first) {
  using Of = When::Kind;
  const auto& row = info(one.word);
  const auto wrong = [&](Span span, Message message, Message help) {
    cursor.fail_at(span, rules::When, std::move(message), std::move(help));
  };
  const auto when = one.when.kind;
  if (said.times.size() > 0 && row.kind != Kind::Event)
    return wrong(said.times, file_texts::CannotBeCounted(row.word), file_texts::RemoveCount());
  if (one.never && said.times.size() > 0)
    return wrong(said.times, file_texts::TakesNoCount("never"), file_texts::WriteNoTimes());
  if (one.never && when == Of::Within)
    return wrong(said.when, file_texts::NeverCoversAll(), file_texts::WriteLike("during 0s..10s"));
  switch (row.kind) {
  case Kind::State: return;
  case Kind::Stay:
    if (when != Of::AnyTime && when != Of::During)
      wrong(said.when, file_texts::StayCoversAll(), file_texts::StayOrInside());
    return;
  case Kind::Event:
    if (when == Of::At || when == Of::AtEnd)
      wrong(said.when, file_texts::EventNotState(row.word),
            file_texts::WriteEither("within 3s", "during 2s..3s"));
    return;
  case Kind::Output:
    if (when != Of::AnyTime)
      wrong(said.when, file_texts::PrintsCoversAll(), file_texts::RemoveTime());
    return;
  case Kind::End:
    if (when != Of::Within)
      wrong(said.when.size() > 0 ? said.when : first, file_texts::EndNeedsWithin(),
            file_texts::WriteLike("expect end within 10s"));
    return;
  case Kind::Final:
    if (when != Of::AtEnd && when != Of::AnyTime)
      wrong(said.when, file_texts::KnownAtEnd(row.word), file_texts::RemoveTimeOrAtEnd());
    else if (one.word == Word::Variable && when != Of::AtEnd)
      wrong(one.name.span, file_texts::VariableKnownAtEnd(), file_texts::Add("at end"));
    return;
  }
}

} // namespace orb::testing
