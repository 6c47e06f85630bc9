#include "testing/text/cursor.h"

#include "base/duration.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "testing/text/rules.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace orb::testing {
namespace {

// Farther, faster and more often than any ball; arithmetic on it stays exact.
constexpr double most_number = 1e9;

bool is_hex_digit(char c) {
  return is_digit(c) || (to_lower(c) >= 'a' && to_lower(c) <= 'f');
}

bool ends_word(char c) {
  return is_blank(c) || c == '#';
}

} // namespace

Cursor::Cursor(const Source& source, std::uint32_t line, std::vector<Diagnostic>& diagnostics)
    : text_(source.line(line)), begin_(source.line_start(line)), at_(byte_order_mark_size(text_)),
      diagnostics_(&diagnostics) {}

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

std::string_view Cursor::color_word() {
  constexpr std::size_t digits = 6;
  skip_blanks();
  const auto text = text_.substr(at_);
  const auto rest = text.substr(0, digits + 1);
  const bool is_color = rest.size() == digits + 1 && rest.front() == '#' &&
                        std::all_of(rest.begin() + 1, rest.end(), is_hex_digit) &&
                        (text.size() == rest.size() || ends_word(text[rest.size()]));
  return is_color ? rest : peek();
}

Span Cursor::hash_span() {
  const auto from = offset();
  if (peek_char() != '#')
    return {from, from};
  const auto end = std::find_if(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(),
                                [](char c) { return is_blank(c); });
  return {from, begin_ + static_cast<std::uint32_t>(end - text_.begin())};
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

void Cursor::character(char wanted, std::string_view help) {
  if (!take(wanted))
    fail(rules::Syntax, fmt::format("missing `{}`", wanted), std::string(help));
}

void Cursor::fail(const Rule& rule, std::string message, std::string help) {
  auto span = peek_span();
  if (span.size() == 0) // at the end of the line: what stands last
    span = {begin_ + static_cast<std::uint32_t>(at_ == 0 ? 0 : at_ - 1),
            begin_ + static_cast<std::uint32_t>(at_)};
  fail_at(span, rule, std::move(message), std::move(help));
}

void Cursor::fail_at(Span span, const Rule& rule, std::string message, std::string help) {
  if (!std::exchange(failed_, true))
    diagnostics_->push_back(finding(rule, span, std::move(message), std::move(help)));
}

std::string Cursor::quoted() {
  if (!take('"')) {
    fail(rules::Syntax, "expected text in quotes");
    return {};
  }
  const auto end = text_.find('"', at_);
  if (end == std::string_view::npos) {
    --at_;
    fail(rules::Syntax, "unterminated string", "add `\"` after it");
    return {};
  }
  const auto found = text_.substr(at_, end - at_);
  at_ = end + 1;
  return std::string(found);
}

std::string Cursor::slashed() {
  const auto open = begin_ + static_cast<std::uint32_t>(at_);
  std::string pattern;
  for (++at_; at_ < text_.size() && text_[at_] != '/'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[++at_] != '/')
      pattern += '\\';
    pattern += text_[at_];
  }
  if (at_ == text_.size())
    fail_at({open, begin_ + static_cast<std::uint32_t>(at_)}, rules::Syntax, "unterminated pattern",
            "add `/` after it");
  else
    ++at_;
  return pattern;
}

std::string Cursor::file_name() {
  if (at_end()) {
    fail(rules::Syntax, "missing file name");
    return {};
  }
  return peek_char() == '"' ? quoted() : std::string(word());
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

double Cursor::number(std::string_view what) {
  const auto from = offset();
  const auto value = digits();
  if (!value)
    fail(rules::Value, at_end() ? fmt::format("missing {}: expected a number", what)
                                : fmt::format("the {} must be a number, found `{}`", what, peek()));
  else if (*value < -most_number || *value > most_number)
    fail_at(span_from(from), rules::Value, fmt::format("the {} is too large", what));
  return value.value_or(0);
}

std::int64_t Cursor::whole(std::string_view what, std::int64_t least, std::int64_t greatest) {
  const auto from = offset();
  const auto value = digits();
  const auto wanted = fmt::format("{} to {}", least, greatest);
  if (!value) {
    fail(rules::Value, at_end()
                           ? fmt::format("missing {}: expected {}", what, wanted)
                           : fmt::format("the {} must be {}, found `{}`", what, wanted, peek()));
    return least;
  }
  if (*value < static_cast<double>(least) || *value > static_cast<double>(greatest) ||
      *value != static_cast<double>(static_cast<std::int64_t>(*value))) {
    const auto span = span_from(from);
    fail_at(span, rules::Value,
            fmt::format("the {} must be {}, found `{}`", what, wanted,
                        text_.substr(span.begin - begin_, span.size())));
    return least;
  }
  return static_cast<std::int64_t>(*value);
}

std::string_view Cursor::unit_word() {
  auto end = at_;
  while (end < text_.size() && (is_letter(text_[end]) || text_[end] == '/'))
    ++end;
  return text_.substr(at_, end - at_);
}

Cursor::Range Cursor::range(std::span<const Unit> units, const Unit& in, std::string_view what,
                            std::string_view example) {
  const auto from = offset();
  const auto help = fmt::format("write it like `{}`", example);
  const auto factor = [&](std::string_view word) {
    const auto* const found = find_unit(word, units);
    return found == nullptr ? 0.0 : found->in(in);
  };
  const auto least = digits();
  const auto first_unit = unit_word();
  at_ += first_unit.size();
  if (!least || !text_.substr(at_).starts_with("..")) {
    at_ = from - begin_;
    fail(rules::Value, fmt::format("the {} needs a lower and an upper bound", what), help);
    return {};
  }
  at_ += 2;
  const auto most = digits();
  const auto unit = unit_word();
  at_ += unit.size();
  const auto span = span_from(from);
  if (!most) {
    fail_at(span, rules::Value, fmt::format("the {} needs a lower and an upper bound", what), help);
    return {};
  }
  const double second = factor(unit);
  const double first = first_unit.empty() ? second : factor(first_unit);
  if (first == 0 || second == 0) {
    const auto wrong = first == 0 && !first_unit.empty() ? first_unit : unit;
    fail_at(span, rules::Value,
            wrong.empty() ? fmt::format("the {} needs a unit", what)
                          : fmt::format("`{}` is not a unit of {}", wrong, what),
            help);
    return {};
  }
  const Range found{*least * first, *most * second};
  if (found.least > found.most)
    fail_at(span, rules::Value, fmt::format("the {} is reversed", what),
            "write the smaller value first");
  else if (found.most > most_number)
    fail_at(span, rules::Value, fmt::format("the {} is too large", what));
  return found;
}

namespace {

constexpr std::array speed_units{unit::cm_s, unit::m_s};

} // namespace

double Cursor::length() {
  const auto from = offset();
  const auto value = digits();
  if (!value) {
    fail(rules::Value,
         at_end() ? std::string("missing length")
                  : fmt::format("expected a number and a unit of length, found `{}`", peek()),
         "write it like `12cm`");
    return 0;
  }
  const auto unit = unit_word();
  at_ += unit.size();
  const auto* const row = find_unit(unit, length_units);
  if (row == nullptr) {
    fail_at(span_from(from), rules::Value,
            unit.empty() ? std::string("the length needs a unit")
                         : fmt::format("`{}` is not a unit of length", unit),
            fmt::format("write `{}cm`",
                        text_.substr(from - begin_, at_ - unit.size() - (from - begin_))));
    return 0;
  }
  const auto cm = *value * row->in(unit::cm);
  if (*value < 0 || cm > most_number)
    fail_at(span_from(from), rules::Value,
            *value < 0 ? std::string("a length cannot be negative")
                       : std::string("the length is too large"));
  return cm;
}

Cursor::Range Cursor::lengths() {
  return range(length_units, unit::cm, "distance", "90cm..110cm");
}

Cursor::Range Cursor::speeds() {
  return range(speed_units, unit::cm_s, "speed", "50..60cm/s");
}

Cursor::Range Cursor::numbers(std::string_view what, std::int64_t least, std::int64_t greatest) {
  const auto from = offset();
  const auto found =
      range({&unit::one, 1}, unit::one, what, fmt::format("{}..{}", least, greatest));
  if (!failed_ &&
      (found.least < static_cast<double>(least) || found.most > static_cast<double>(greatest)))
    fail_at(span_from(from), rules::Value,
            fmt::format("the {} must be {} to {}", what, least, greatest));
  return found;
}

namespace {

/// Whether a time has a number and a unit, and is only too much of it.
bool is_too_long(std::string_view text) {
  const auto amount = split_amount(text);
  return !amount.number.empty() && is_digit(text.front()) &&
         parse_duration("1" + std::string(amount.rest)).has_value();
}

} // namespace

Duration Cursor::time() {
  const auto text = peek();
  const auto found = parse_duration(text);
  if (!found && is_too_long(text)) {
    fail(rules::Value, fmt::format("`{}` is longer than a year", text),
         "a run lasts at most a year; write its length like `60s` or `10min`");
    return {};
  }
  if (!found) {
    constexpr double most_seconds = 100; // a larger number without a unit is milliseconds
    const auto number = parse_number<double>(text, std::chars_format::fixed);
    fail(rules::Value,
         at_end() ? std::string("missing time")
                  : fmt::format("expected a number and a unit of time, found `{}`", text),
         number ? fmt::format("write `{}{}`", text, *number < most_seconds ? "s" : "ms")
                : "write it like `2.5s` or `800ms`");
    return {};
  }
  at_ += text.size();
  return *found;
}

std::pair<Duration, Duration> Cursor::times() {
  const auto text = peek();
  const auto dots = text.find("..");
  const auto to =
      dots == std::string_view::npos ? std::nullopt : parse_duration(text.substr(dots + 2));
  auto from = dots == std::string_view::npos ? std::nullopt : parse_duration(text.substr(0, dots));
  if (to && !from) // `2..3s`: the unit of the second
    from = parse_duration(
        fmt::format("{}{}", text.substr(0, dots), split_amount(text.substr(dots + 2)).rest));
  if (!from || !to) {
    fail(rules::Value,
         at_end() ? std::string("missing time span")
                  : fmt::format("expected a start and an end time, found `{}`", text),
         "write it like `2s..3s`");
    return {};
  }
  if (*from > *to) {
    fail(rules::Value, "the time span is reversed", "write the earlier time first");
    return {};
  }
  at_ += text.size();
  return {*from, *to};
}

} // namespace orb::testing
