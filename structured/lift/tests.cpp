#include "structured/lift/tests.h"

#include "compiler/analyse/reading.h"
#include "structured/lift/effects.h"

#include <cstdlib>
#include <fmt/format.h>

namespace orb::structured::lifting {
namespace {

using compiler::Holds;
using compiler::Orders;

std::int32_t step_of(const compiler::Program& program, const compiler::ForView& loop) {
  if (loop.step == nullptr)
    return 1;
  const auto root = loop.step->value;
  const auto& node = program.nodes[root];
  return node.kind == compiler::NodeKind::Negate ? -program.nodes[root - 1].value : node.value;
}

bool ends_at_number(const compiler::Program& program, const compiler::ForView& loop) {
  return program.nodes[loop.end.value].kind == compiler::NodeKind::Number;
}

} // namespace

const std::string& LiftedTests::helper(std::uint32_t step, std::uint32_t nth,
                                       std::string_view wish) {
  auto& name = helpers_[{step, nth}];
  if (name.empty())
    name = names_.fresh(wish);
  return name;
}

// ---- `if`

std::string LiftedTests::condition(std::uint32_t step, bool negated) {
  const auto view = program_.as<compiler::IfView>(statement_of(program_, ways_, step));
  auto text = relation(step, view.first, 0, negated);
  if (view.second)
    text += fmt::format(" {} {}",
                        (view.joint->kind == compiler::ItemKind::And) != negated ? "and" : "or",
                        relation(step, *view.second, 2, negated));
  return text;
}

std::string LiftedTests::relation(std::uint32_t step, const compiler::Comparison& comparison,
                                  std::uint32_t first, bool negated) {
  const auto side = [&](const compiler::Item& item, std::uint32_t nth) {
    const bool computed = prepared_[step] && acts(program_, item);
    return computed ? helper(step, first + nth, "seen") : values_.text(item);
  };
  auto left = side(comparison.left, 0);
  const auto sign = sign_of(orders_of(comparison, negated ? Holds::No : Holds::Yes), "<>");
  return fmt::format("{} {} {}", left, sign, side(comparison.right, 1));
}

std::vector<std::string> LiftedTests::prepare(std::uint32_t step) {
  std::vector<std::string> lines;
  if (!prepared_[step])
    return lines;
  const auto view = program_.as<compiler::IfView>(statement_of(program_, ways_, step));
  std::uint32_t nth = 0;
  for (const auto* item :
       {&view.first.left, &view.first.right, &view.second->left, &view.second->right}) {
    if (acts(program_, *item))
      lines.push_back(fmt::format("{} = {}", helper(step, nth, "seen"), values_.text(*item)));
    ++nth;
  }
  return lines;
}

// ---- loops that cannot be a `for`

std::vector<std::string> LiftedTests::begin_loop(std::uint32_t step) {
  const auto loop = program_.as<compiler::ForView>(statement_of(program_, ways_, step));
  std::vector<std::string> lines{
      fmt::format("{} = {}", values_.letter_set(loop.variable.value), values_.text(loop.start))};
  if (!ends_at_number(program_, loop))
    lines.push_back(fmt::format("{} = {}", end_of(step, loop), values_.text(loop.end)));
  return lines;
}

std::string LiftedTests::count(std::uint32_t step) {
  const auto loop = program_.as<compiler::ForView>(statement_of(program_, ways_, step));
  const auto by = step_of(program_, loop);
  return fmt::format("{} {}= {}", values_.letter_set(loop.variable.value), by < 0 ? '-' : '+',
                     std::abs(std::int64_t{by}));
}

std::string LiftedTests::is_over(std::uint32_t step, bool negated) {
  const auto loop = program_.as<compiler::ForView>(statement_of(program_, ways_, step));
  const auto over = step_of(program_, loop) > 0 ? Orders::Greater : Orders::Less;
  return fmt::format("{} {} {}", values_.letter_read(loop.variable.value),
                     sign_of(negated ? opposite(over) : over, "<>"), end_of(step, loop));
}

/// The end of a loop: a number, or the variable that stores it.
std::string LiftedTests::end_of(std::uint32_t step, const compiler::ForView& loop) {
  if (ends_at_number(program_, loop))
    return values_.text(loop.end);
  return helper(step, 0, "last_" + names_.letter(loop.variable.value));
}

} // namespace orb::structured::lifting
