#include "base/cursor.h"

#include "base/duration.h"
#include "base/fixes.h"
#include "base/meant.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

namespace orb {
namespace {

using Kind = Slot::Kind;

// Beyond any distance, speed or count of a ball; double arithmetic below it stays exact.
constexpr double most_number = 1e9;

bool ends_word(char c) {
  return is_blank(c) || c == '#';
}

Message missing(const Slot& slot) {
  if (slot.kind == Kind::Place)
    return texts::MissingNumber(Message::as_is("x"));
  if (slot.kind == Kind::Axis)
    return texts::LineSuchAs(slot.usual);
  if (slot.kind == Kind::Text || slot.kind == Kind::Match)
    return texts::TextInQuotes();
  if (slot.kind == Kind::Range)
    return texts::NeedsBounds(slot.name());
  const auto words = slot.choices();
  return slot.kind == Kind::Choice ? texts::MissingEither(slot.name(), words.front(), words.back())
         : slot.is_limited() && !slot.is_any()
             ? texts::MissingRange(slot.name(), slot.least, slot.most)
         : slot.is_any() || slot.kind == Kind::Number ? texts::MissingNumber(slot.name())
                                                      : texts::MissingValue(slot.name());
}

/// The help line: the slot's usual form.
Message example(const Slot& slot) {
  if (slot.kind == Kind::Place)
    return texts::PlaceIsWritten();
  if (slot.kind == Kind::Time && slot.before.empty())
    return texts::WriteLikeEither("2.5s", "800ms");
  if (slot.usual.empty() || slot.kind == Kind::Axis)
    return {};
  return texts::WriteLike(
      fmt::format("{}{}{}", slot.before, slot.before.empty() ? "" : " ", slot.usual));
}

/// True if the text is a well-formed time that is out of range.
bool is_too_long(std::string_view text) {
  const auto amount = split_amount(text);
  return !amount.number.empty() && is_digit(text.front()) &&
         parse_duration("1" + std::string(amount.rest)).has_value();
}

} // namespace

Cursor::Cursor(const Source& source, std::uint32_t line)
    : text_(source.line(line)), begin_(source.line_start(line)), at_(byte_order_mark_size(text_)) {}

Cursor::Cursor(const Source& source, std::uint32_t line, std::vector<Diagnostic>& diagnostics,
               const Rule& syntax, const Rule& value)
    : Cursor(source, line) {
  diagnostics_ = &diagnostics;
  syntax_ = &syntax;
  value_ = &value;
}

void Cursor::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_]))
    ++at_;
}

bool Cursor::at_end() {
  skip_blanks();
  return at_ == text_.size() || text_[at_] == '#';
}

std::uint32_t Cursor::offset() {
  skip_blanks();
  return begin_ + static_cast<std::uint32_t>(at_);
}

Span Cursor::span_from(std::uint32_t from) const {
  auto end = at_;
  while (end > 0 && is_blank(text_[end - 1]))
    --end;
  return {from, std::max(from, begin_ + static_cast<std::uint32_t>(end))};
}

std::string_view Cursor::peek() {
  skip_blanks();
  const auto end =
      std::find_if(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), ends_word);
  return text_.substr(at_, static_cast<std::size_t>(end - text_.begin()) - at_);
}

Span Cursor::peek_span() {
  const auto from = offset();
  const auto size = static_cast<std::uint32_t>(peek().size());
  return {from, from + size};
}

char Cursor::peek_char() {
  skip_blanks();
  return at_ < text_.size() ? text_[at_] : '\0';
}

std::string_view Cursor::word() {
  const auto found = peek();
  at_ += found.size();
  return found;
}

Span Cursor::take_rest() {
  const auto from = offset();
  while (!at_end())
    word();
  return span_from(from);
}

bool Cursor::take(char wanted) {
  if (peek_char() != wanted)
    return false;
  ++at_;
  return true;
}

bool Cursor::take_word(std::string_view wanted) {
  if (peek() != wanted)
    return false;
  at_ += wanted.size();
  return true;
}

void Cursor::fail(const Rule& rule, Message message, Message help) {
  auto span = peek_span();
  if (span.size() == 0) // at the end of the line: the last token
    span = {begin_ + static_cast<std::uint32_t>(at_ == 0 ? 0 : at_ - 1),
            begin_ + static_cast<std::uint32_t>(at_)};
  fail_at(span, rule, std::move(message), std::move(help));
}

void Cursor::fail_at(Span span, const Rule& rule, Message message, Message help) {
  if (!std::exchange(failed_, true) && diagnostics_ != nullptr)
    diagnostics_->push_back(finding(rule, span, std::move(message), std::move(help)));
}

std::vector<SlotValue> Cursor::read(std::span<const Slot> slots) {
  std::vector<SlotValue> values(slots.size());
  for (std::size_t i = 0; i < slots.size() && !failed_; ++i)
    if (!slots[i].may_lack)
      values[i] = read(slots[i]);
  for (std::size_t i = 0; i < slots.size() && !failed_;) {
    const bool is_next = !values[i].is_given() && begins(slots[i]);
    if (is_next)
      values[i] = read(slots[i]);
    i = is_next ? 0 : i + 1;
  }
  return values;
}

bool Cursor::begins(const Slot& slot) {
  if (!slot.may_lack || slot.before.empty() || peek() != slot.before)
    return false;
  auto ahead = *this;
  ahead.word();
  return slot.kind == Kind::Time || !parse_duration(ahead.word()); // `by 200ms` belongs to `after`
}

bool Cursor::take_before(const Slot& slot) {
  const bool is_sign = slot.before.size() == 1 && !is_letter(slot.before[0]);
  return is_sign ? take(slot.before[0]) : take_word(slot.before);
}

SlotValue Cursor::read(const Slot& slot) {
  SlotValue value;
  if (slot.kind == Kind::Rest)
    return value;
  if (!slot.before.empty() && !take_before(slot))
    fail(*syntax_,
         is_letter(slot.before[0]) ? texts::MissingWithWord(slot.before, slot.name())
                                   : texts::Missing(slot.before),
         example(slot));
  const auto from = offset();
  if (failed_)
    return value;
  if (at_end() && slot.kind != Kind::Colour)
    fail(*syntax_, missing(slot), example(slot));
  else
    read_value(slot, value);
  if (!failed_)
    value.span = span_from(from);
  return value;
}

void Cursor::read_value(const Slot& slot, SlotValue& value) {
  switch (slot.kind) {
  case Kind::Number:
  case Kind::Whole: return read_number(slot, value);
  case Kind::Length: return read_length(slot, value);
  case Kind::Range: return read_range(slot, value);
  case Kind::Time: return read_time(slot, value);
  case Kind::TimeSpan: return read_times(slot, value);
  case Kind::Axis: return read_axis(slot, value);
  case Kind::Match: return read_match(value);
  case Kind::Choice: return read_choice(slot, value);
  case Kind::Place:
    value.least = read_coordinate("x");
    if (!take(','))
      fail(*syntax_, texts::Missing(','), example(slot));
    value.most = read_coordinate("y");
    return;
  case Kind::Text: value.text = quoted(); return;
  case Kind::File:
  case Kind::Zone:
  case Kind::Macro: value.text = peek_char() == '"' ? quoted() : std::string(word()); return;
  case Kind::Variable:
    value.text = peek().substr(0, peek().find('='));
    at_ += value.text.size();
    return;
  case Kind::Word:
  case Kind::Version:
  case Kind::Firmware:
  case Kind::Seeds: value.text = word(); return;
  case Kind::Colour: {
    // A leading `#` is a colour, not a comment.
    const auto rest = text_.substr(at_);
    const auto end = std::min(rest.find_first_of(" \t#", 1), rest.size());
    value.text = rest.starts_with('#') && end > 1 ? rest.substr(0, end) : peek();
    at_ += value.text.size();
    if (value.text.empty())
      fail(*syntax_, missing(slot), example(slot));
    return;
  }
  case Kind::Rest: return;
  }
}

void Cursor::wrong(const Slot& slot, Message problem) {
  fail(*value_, texts::Found(std::move(problem), peek()),
       meant_or(peek(), slot.choices(), example(slot)));
}

void Cursor::read_number(const Slot& slot, SlotValue& value) {
  const auto from = offset();
  const auto all = peek();
  const auto number = digits();
  const auto unit = slot.units.empty() ? std::string_view() : unit_word();
  const bool has_unit = unit.empty() || find_unit(unit, slot.units) != nullptr;
  const bool is_whole = slot.kind != Kind::Whole || (number && *number == std::trunc(*number));
  if (!number || !has_unit || !is_whole || span_from(from).size() != all.size() ||
      (slot.is_limited() &&
       (*number < static_cast<double>(slot.least) || *number > static_cast<double>(slot.most)))) {
    go_back_to(from);
    return wrong(slot, slot.is_any() && !number ? texts::MustBeNumber(slot.name()) : must_be(slot));
  }
  if (std::abs(*number) > most_number && !slot.is_limited())
    fail_at(span_from(from), *value_, texts::TooLarge(slot.name()));
  value.most = *number;
}

double Cursor::read_coordinate(std::string_view axis) {
  const auto from = offset();
  const auto name = Message::as_is(std::string(axis));
  const auto number = digits();
  if (!number)
    fail(*value_,
         at_end() ? texts::MissingNumber(name) : texts::Found(texts::MustBeNumber(name), peek()));
  else if (std::abs(*number) > most_number)
    fail_at(span_from(from), *value_, texts::TooLarge(name));
  return number.value_or(0);
}

void Cursor::read_length(const Slot& slot, SlotValue& value) {
  const auto from = offset();
  const auto number = digits();
  if (!number)
    return wrong(slot, texts::Expected(texts::NumberAndUnitOfLength()));
  const auto written = text_.substr(from - begin_, at_ - (from - begin_));
  const auto word = unit_word();
  const auto* const unit = find_unit(word, slot.units);
  if (unit == nullptr)
    return fail_at(span_from(from), *value_,
                   word.empty() ? texts::NeedsUnit(slot.name())
                                : texts::NotAUnit(word, slot.name()),
                   texts::Write(fmt::format("{}{}", written, slot.units.front().word)));
  value.most = *number * unit->in(slot.units.front());
  if (value.most < 0 || value.most > most_number)
    fail_at(span_from(from), *value_,
            value.most < 0 ? texts::Negative(slot.name()) : texts::TooLarge(slot.name()));
}

void Cursor::read_range(const Slot& slot, SlotValue& value) {
  const auto from = offset();
  const auto least = digits();
  const auto first = unit_word();
  const bool goes_on = least && text_.substr(at_).starts_with("..");
  at_ += goes_on ? 2 : 0;
  const auto most = goes_on ? digits() : std::nullopt;
  if (!most) {
    go_back_to(from);
    return fail(*value_, texts::NeedsBounds(slot.name()), example(slot));
  }
  const auto second = unit_word();
  const auto span = span_from(from);
  const auto* const upper = find_unit(second, slot.units);
  const auto* const lower = first.empty() ? upper : find_unit(first, slot.units);
  if (upper == nullptr || lower == nullptr) {
    const auto wrong = lower == nullptr && !first.empty() ? first : second;
    return fail_at(span, *value_,
                   wrong.empty() ? texts::NeedsUnit(slot.name())
                                 : texts::NotAUnit(wrong, slot.name()),
                   example(slot));
  }
  value.least = *least * lower->in(slot.units.front());
  value.most = *most * upper->in(slot.units.front());
  if (value.least > value.most)
    fail_at(span, *value_, texts::Reversed(slot.name()), texts::SmallerFirst());
  else if (value.most > most_number)
    fail_at(span, *value_, texts::TooLarge(slot.name()));
  else if (slot.is_limited() && (value.least < static_cast<double>(slot.least) ||
                                 value.most > static_cast<double>(slot.most)))
    fail_at(span, *value_, must_be(slot));
}

void Cursor::read_time(const Slot& slot, SlotValue& value) {
  value.which = !slot.words.empty() && take_word(slot.words) ? 1 : 0;
  if (value.which == 1)
    return;
  const auto text = peek();
  const auto time = parse_duration(text);
  constexpr double most_seconds = 100; // above this, a number without a unit is milliseconds
  if (time) {
    value.to = *time;
    at_ += text.size();
  } else if (is_too_long(text)) {
    fail(*value_, texts::LongerThanAYear(text), texts::AtMostAYear());
  } else {
    const auto number = parse_number<double>(text, std::chars_format::fixed);
    fail(*value_, texts::Found(texts::Expected(texts::NumberAndUnitOfTime()), text),
         number ? texts::Write(fmt::format("{}{}", text, *number < most_seconds ? "s" : "ms"))
                : example(slot));
  }
}

void Cursor::read_times(const Slot& slot, SlotValue& value) {
  const auto text = peek();
  const auto dots = std::min(text.find(".."), text.size());
  const auto end = text.substr(std::min(dots + 2, text.size()));
  const auto to = parse_duration(end);
  auto from = parse_duration(text.substr(0, dots));
  if (to && !from) // `2..3s`: the first number takes the second's unit
    from = parse_duration(fmt::format("{}{}", text.substr(0, dots), split_amount(end).rest));
  if (!from || !to)
    return wrong(slot, texts::TwoTimes());
  if (*from > *to)
    return fail(*value_, texts::Reversed(slot.name()), texts::EarlierFirst());
  value.from = *from;
  value.to = *to;
  at_ += text.size();
}

void Cursor::read_axis(const Slot& slot, SlotValue& value) {
  const auto from = offset();
  const auto all = peek();
  const bool is_axis = take('x') || take('y');
  value.text = text_[is_axis ? at_ - 1 : at_];
  value.which = slot.words.find(peek_char());
  const bool has_sign = is_axis && value.which != std::string_view::npos;
  at_ += has_sign ? 1 : 0;
  const auto number = has_sign ? digits() : std::nullopt;
  const auto farthest = slot.is_limited() ? static_cast<double>(slot.most) : most_number;
  // A number without a unit must end the word.
  if (!number || std::abs(*number) > farthest ||
      (slot.units.empty() && span_from(from).size() != all.size())) {
    go_back_to(from);
    return wrong(slot, texts::LineSuchAs(slot.usual));
  }
  value.most = *number;
  if (!slot.units.empty())
    take_word(slot.units.front().word);
}

void Cursor::read_choice(const Slot& slot, SlotValue& value) {
  const auto words = slot.choices();
  const auto found = std::find(words.begin(), words.end(), peek());
  if (found == words.end())
    return wrong(slot, must_be(slot));
  value.which = static_cast<std::size_t>(found - words.begin());
  value.text = word();
}

void Cursor::read_match(SlotValue& value) {
  const bool is_part = take('~');
  value.which = is_part ? 1 : peek_char() == '/' ? 2 : 0;
  value.text = value.which == 2 ? slashed() : quoted();
}

std::string Cursor::quoted() {
  const auto from = offset();
  const auto end = take('"') ? text_.find('"', at_) : at_;
  if (end != std::string_view::npos && end > from - begin_) {
    const auto found = text_.substr(at_, end - at_);
    at_ = end + 1;
    return std::string(found);
  }
  const bool opens = at_ != from - begin_;
  go_back_to(from);
  fail(*syntax_, opens ? texts::UnterminatedString() : texts::TextInQuotes(),
       opens ? texts::AddAfter('"') : Message());
  return {};
}

std::string Cursor::slashed() {
  const auto open = offset();
  std::string pattern;
  for (++at_; at_ < text_.size() && text_[at_] != '/'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[++at_] != '/')
      pattern += '\\';
    pattern += text_[at_];
  }
  if (at_ < text_.size()) {
    ++at_;
    return pattern;
  }
  // The last `$` of a pattern is its end.
  const auto dollar = text_.rfind('$');
  const bool anchored = dollar != std::string_view::npos && begin_ + dollar > open;
  const auto end = begin_ + static_cast<std::uint32_t>(anchored ? dollar + 1 : text_.size());
  const bool is_first = !failed_ && diagnostics_ != nullptr;
  fail_at({open, end}, *syntax_, texts::UnterminatedPattern(), texts::AddAfter('/'));
  if (is_first)
    diagnostics_->back().fix = single_fix(texts::AddAfter('/'), {end, end}, "/", Safety::Unsafe);
  return pattern;
}

std::optional<double> Cursor::digits() {
  skip_blanks();
  const auto written = split_amount(text_.substr(at_)).number;
  const auto number = written.substr(written.starts_with('+') ? 1 : 0);
  const auto value = parse_number<double>(number, std::chars_format::fixed);
  if (value)
    at_ += written.size();
  return value;
}

std::string_view Cursor::unit_word() {
  const auto begin = at_;
  while (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '/'))
    ++at_;
  return text_.substr(begin, at_ - begin);
}

} // namespace orb
