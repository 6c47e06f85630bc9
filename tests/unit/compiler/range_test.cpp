#include "compiler/analyse/range.h"

#include "base/random.h"
#include "bytecode/arithmetic.h"

#include <gtest/gtest.h>
#include <limits>
#include <optional>

namespace orb::compiler {
namespace {

constexpr auto least = std::numeric_limits<std::int32_t>::min();
constexpr auto greatest = std::numeric_limits<std::int32_t>::max();

TEST(Range, OfConstantsIsConstant) {
  const auto of = [](spec::Operator op, std::int32_t a, std::int32_t b) {
    return apply(op, Range::only(a), Range::only(b));
  };
  EXPECT_EQ(of(spec::Operator::Add, 2, 3), Range::only(5));
  EXPECT_EQ(of(spec::Operator::Divide, -7, 2), Range::only(-3));
  EXPECT_EQ(of(spec::Operator::Remainder, -7, 2), Range::only(-1));
  EXPECT_EQ(of(spec::Operator::ShiftLeft, 3, 2), Range::only(12));
  EXPECT_EQ(of(spec::Operator::ShiftRight, -3, 1), Range::only(-2));
  EXPECT_EQ(of(spec::Operator::And, 45, 85), Range::only(5));
  EXPECT_EQ(of(spec::Operator::Or, 45, 85), Range::only(125));
  EXPECT_EQ(of(spec::Operator::Add, greatest, 1), Range::only(least));
  EXPECT_EQ(apply(spec::Operator::Add, Range{0, greatest}, Range::only(1)), Range())
      << "of several values, what wraps is unknown";
}

TEST(Range, OfAFunction) {
  EXPECT_EQ(apply(spec::Function::Sqrt, Range{0, 600000}), (Range{0, 774}));
  EXPECT_EQ(apply(spec::Function::Rnd, Range{5, 6}), (Range{1, 6}));
  EXPECT_EQ(apply(spec::Function::Abs, Range{-9, 4}), (Range{0, 9}));
  EXPECT_EQ(apply(spec::Function::Abs, Range{-9, -4}), (Range{4, 9}));
  EXPECT_EQ(apply(spec::Function::Abs, Range{least, 0}), Range());
}

TEST(Range, CountsTheCharactersOfPrintedNumbers) {
  EXPECT_EQ(printed(Range()).most, 11U);
  EXPECT_EQ(printed(Range()).least, 1U);
  EXPECT_EQ(printed(Range{100, 2000}).least, 3U);
  EXPECT_EQ(printed(Range{100, 2000}).most, 4U);
  EXPECT_EQ(printed(Range{-359, -5}).least, 2U);
  EXPECT_EQ(printed(Range{-359, -5}).most, 4U);
}

/// Returns the machine's result; nothing if it would stop.
std::optional<std::int32_t> calculate(spec::Operator op, std::int32_t a, std::int32_t b) {
  const bool shift = b >= 0 && b <= 31;
  switch (op) {
  case spec::Operator::Multiply: return bytecode::multiply(a, b);
  case spec::Operator::Divide: return b == 0 ? std::nullopt : std::optional(bytecode::divide(a, b));
  case spec::Operator::Remainder:
    return b == 0 ? std::nullopt : std::optional(bytecode::remainder(a, b));
  case spec::Operator::ShiftLeft:
    return shift ? std::optional(bytecode::shift_left(a, b)) : std::nullopt;
  case spec::Operator::ShiftRight:
    return shift ? std::optional(bytecode::shift_right(a, b)) : std::nullopt;
  case spec::Operator::Add: return bytecode::add(a, b);
  case spec::Operator::Subtract: return bytecode::subtract(a, b);
  case spec::Operator::And: return a & b;
  case spec::Operator::Or: return a | b;
  }
  return std::nullopt;
}

/// Returns a number that is often close to a limit.
std::int32_t number(Random& random) {
  switch (random.below(4)) {
  case 0: return static_cast<std::int32_t>(random.below(20)) - 10;
  case 1: return static_cast<std::int32_t>(random.below(2000)) - 1000;
  case 2: return random.chance(0.5) ? least : greatest;
  default: return static_cast<std::int32_t>(random.next());
  }
}

Range range(Random& random) {
  const auto a = number(random);
  const auto b = random.chance(0.3) ? a : number(random);
  return {std::min(a, b), std::max(a, b)};
}

std::int32_t within(Random& random, Range range) {
  if (random.chance(0.2))
    return random.chance(0.5) ? range.lo : range.hi;
  const auto size = static_cast<std::uint64_t>(static_cast<std::int64_t>(range.hi) - range.lo) + 1;
  return static_cast<std::int32_t>(range.lo + static_cast<std::int64_t>(random.below(size)));
}

// The computed range contains every result for operands from two ranges.
TEST(Range, HoldsWhatTheMachineComputes) {
  Random random{11};
  for (int n = 0; n < 200000; ++n) {
    const auto left = range(random);
    const auto right = range(random);
    const auto a = within(random, left);
    const auto b = within(random, right);
    const auto& row = spec::operators[random.below(spec::operators.size())];
    const auto result = calculate(row.op, a, b);
    if (!result)
      continue;
    const auto foretold = apply(row.op, left, right);
    ASSERT_TRUE(foretold.has(*result)) << a << ' ' << row.symbol << ' ' << b << " = " << *result
                                       << ", not within " << foretold.lo << " to " << foretold.hi;
  }
}

} // namespace
} // namespace orb::compiler
