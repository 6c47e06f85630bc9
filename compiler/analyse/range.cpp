#include "compiler/analyse/range.h"

#include "compiler/text/texts.h"
#include "spec/limits.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace orb::compiler {
namespace {

/// Narrows a 64-bit range; beyond 32 bits the result wraps, so nothing is known of several values.
Range narrow(std::int64_t lo, std::int64_t hi) {
  if (lo == hi)
    return Range::only(static_cast<std::int32_t>(lo));
  if (lo < std::numeric_limits<std::int32_t>::min() ||
      hi > std::numeric_limits<std::int32_t>::max())
    return {};
  return {static_cast<std::int32_t>(lo), static_cast<std::int32_t>(hi)};
}

Range hull(std::initializer_list<std::int64_t> values) {
  const auto [lo, hi] = std::minmax(values);
  return narrow(lo, hi);
}

std::int64_t magnitude(const Range& range) {
  return std::max(std::abs(static_cast<std::int64_t>(range.lo)),
                  std::abs(static_cast<std::int64_t>(range.hi)));
}

Range divide(const Range& left, const Range& right) {
  const std::int64_t lo = left.lo;
  const std::int64_t hi = left.hi;
  if (right.lo > 0 || right.hi < 0)
    return hull({lo / right.lo, lo / right.hi, hi / right.lo, hi / right.hi});
  return narrow(-magnitude(left), magnitude(left));
}

Range remainder(const Range& left, const Range& right) {
  if (left.constant() && right.constant() && right.lo != 0)
    return hull({static_cast<std::int64_t>(left.lo) % right.lo});
  if (right.constant() && has_one_quotient(left, right.lo))
    return {left.lo % right.lo, left.hi % right.lo};
  const auto most = std::min(magnitude(left), std::max<std::int64_t>(magnitude(right) - 1, 0));
  return narrow(left.lo < 0 ? -most : 0, left.hi > 0 ? most : 0);
}

Range shift_left(const Range& left, const Range& right) {
  const int from = std::clamp(right.lo, 0, spec::value_of(spec::Limit::GreatestShift));
  const int to = std::clamp(right.hi, 0, spec::value_of(spec::Limit::GreatestShift));
  const auto times = [](std::int32_t value, int bits) {
    return static_cast<std::int64_t>(value) * (std::int64_t{1} << bits);
  };
  return hull({times(left.lo, from), times(left.lo, to), times(left.hi, from), times(left.hi, to)});
}

Range shift_right(const Range& left, const Range& right) {
  const int from = std::clamp(right.lo, 0, spec::value_of(spec::Limit::GreatestShift));
  const int to = std::clamp(right.hi, 0, spec::value_of(spec::Limit::GreatestShift));
  return hull({left.lo >> from, left.lo >> to, left.hi >> from, left.hi >> to});
}

/// Sets all bits below the highest set one.
std::int32_t fill(std::int32_t value) {
  auto bits = static_cast<std::uint32_t>(value);
  for (int n = 1; n < 32; n *= 2)
    bits |= bits >> n;
  return static_cast<std::int32_t>(bits);
}

Range bit_and(const Range& left, const Range& right) {
  if (left.constant() && right.constant())
    return Range::only(left.lo & right.lo);
  if (left.lo >= 0 && right.lo >= 0)
    return {0, std::min(left.hi, right.hi)};
  if (left.lo >= 0)
    return {0, left.hi};
  if (right.lo >= 0)
    return {0, right.hi};
  return {};
}

Range bit_or(const Range& left, const Range& right) {
  if (left.constant() && right.constant())
    return Range::only(left.lo | right.lo);
  if (left.lo >= 0 && right.lo >= 0)
    return {std::max(left.lo, right.lo), fill(left.hi | right.hi)};
  return {};
}

std::int32_t root(std::int32_t value) {
  return static_cast<std::int32_t>(std::sqrt(static_cast<double>(std::max(value, 0))));
}

std::uint32_t digits(std::int64_t value) {
  std::uint32_t n = value < 0 ? 2 : 1;
  for (value = std::abs(value); value >= 10; value /= 10)
    ++n;
  return n;
}

} // namespace

Range apply(spec::Operator op, const Range& left, const Range& right) {
  const std::int64_t a = left.lo;
  const std::int64_t b = left.hi;
  const std::int64_t c = right.lo;
  const std::int64_t d = right.hi;
  switch (op) {
  case spec::Operator::Multiply: return hull({a * c, a * d, b * c, b * d});
  case spec::Operator::Divide: return divide(left, right);
  case spec::Operator::Remainder: return remainder(left, right);
  case spec::Operator::ShiftLeft: return shift_left(left, right);
  case spec::Operator::ShiftRight: return shift_right(left, right);
  case spec::Operator::Add: return narrow(a + c, b + d);
  case spec::Operator::Subtract: return narrow(a - d, b - c);
  case spec::Operator::And: return bit_and(left, right);
  case spec::Operator::Or: return bit_or(left, right);
  }
  return {};
}

Range apply(spec::Function function, const Range& operand) {
  switch (function) {
  case spec::Function::Sqrt: return {root(operand.lo), root(operand.hi)};
  case spec::Function::Rnd: return {1, std::max(operand.hi, 1)};
  case spec::Function::Abs:
    if (operand.lo >= 0)
      return operand;
    if (operand.lo == std::numeric_limits<std::int32_t>::min())
      return {}; // INT32_MIN has no positive counterpart
    if (operand.hi <= 0)
      return {-operand.hi, -operand.lo};
    return {0, std::max(-operand.lo, operand.hi)};
  }
  return {};
}

bool has_one_quotient(Range left, std::int32_t divisor) {
  return divisor != 0 && (left.lo >= 0 || left.hi <= 0) &&
         std::int64_t{left.lo} / divisor == std::int64_t{left.hi} / divisor;
}

std::optional<Range> where(Orders orders, Range left, Range right) {
  std::optional<Range> found;
  const auto add = [&](std::int64_t lo, std::int64_t hi) {
    if (lo <= hi)
      found = found ? join(*found, narrow(lo, hi)) : narrow(lo, hi);
  };
  if (has(orders, Orders::Less))
    add(left.lo, std::min<std::int64_t>(left.hi, std::int64_t{right.hi} - 1));
  if (has(orders, Orders::Equal))
    add(std::max(left.lo, right.lo), std::min(left.hi, right.hi));
  if (has(orders, Orders::Greater))
    add(std::max<std::int64_t>(left.lo, std::int64_t{right.lo} + 1), left.hi);
  return found;
}

std::optional<bool> answer_of(Orders orders, Range left, Range right) {
  if (!where(orders, left, right))
    return false;
  return where(opposite(orders), left, right) ? std::nullopt : std::optional(true);
}

Message allowed_values(std::string_view word, const spec::Parameter& parameter) {
  return parameter.name.empty() ? texts::Takes(word, parameter.least, parameter.greatest)
                                : texts::MustBe(texts::of_table(parameter.name), word,
                                                parameter.least, parameter.greatest);
}

std::optional<std::int32_t> nearest_allowed(const spec::Parameter& parameter, std::int32_t value) {
  const auto& heading = spec::info(spec::Variable::Hdgval);
  const auto& speed = spec::info(spec::Variable::Spdval); // colours have the same range
  if (parameter.least == heading.least && parameter.greatest == heading.greatest) {
    const auto turn = std::int64_t{parameter.greatest} + 1;
    return static_cast<std::int32_t>((value % turn + turn) % turn);
  }
  if (parameter.least != speed.least || parameter.greatest != speed.greatest)
    return std::nullopt;
  if (value < 0 && parameter.name == "speed")
    return std::nullopt; // a negative speed means reverse, not stop
  return std::clamp(value, parameter.least, parameter.greatest);
}

std::optional<std::int32_t> heading_back(std::int64_t heading, std::int64_t speed) {
  const auto parameters = spec::info(spec::Statement::Goroll).parameters();
  const auto& headings = parameters[0];
  if (heading < headings.least || heading > headings.greatest || speed >= 0 ||
      -speed > parameters[1].greatest)
    return std::nullopt;
  const auto turn = std::int64_t{headings.greatest} + 1;
  return static_cast<std::int32_t>((heading + turn / 2) % turn);
}

Range widen(std::span<const std::int32_t> landmarks, Range before, Range now) {
  if (now.lo < before.lo)
    now.lo = *std::prev(std::upper_bound(landmarks.begin(), landmarks.end(), now.lo));
  if (now.hi > before.hi)
    now.hi = *std::lower_bound(landmarks.begin(), landmarks.end(), now.hi);
  return now;
}

std::vector<std::int32_t> landmarks_of(std::vector<std::int32_t> named) {
  constexpr auto least = std::numeric_limits<std::int32_t>::min();
  constexpr auto greatest = std::numeric_limits<std::int32_t>::max();
  std::sort(named.begin(), named.end());
  std::vector<std::int32_t> landmarks{least};
  const auto add = [&](std::int64_t value) {
    if (value > landmarks.back() && value <= greatest)
      landmarks.push_back(static_cast<std::int32_t>(value));
  };
  for (const std::int64_t value : named) {
    add(value - 1);
    add(value);
    add(value + 1);
  }
  add(greatest);
  return landmarks;
}

Message shown(Range range) {
  return range.constant() ? Message::as_is(std::to_string(range.lo))
                          : texts::FromTo(range.lo, range.hi);
}

Digits printed(Range range) {
  const auto lo = digits(range.lo);
  const auto hi = digits(range.hi);
  const bool crosses = range.lo <= 0 && range.hi >= 0;
  std::uint32_t least = std::min(lo, hi);
  if (crosses)
    least = 1;
  else if (range.lo > 0)
    least = lo;
  else
    least = hi;
  return {least, std::max(lo, hi)};
}

} // namespace orb::compiler
