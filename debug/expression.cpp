#include "debug/expression.h"

#include "base/render.h"
#include "base/text/text.h"
#include "bytecode/arithmetic.h"
#include "structured/text/parse_structured.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::debug {
namespace {

using structured::Node;
using structured::NodeKind;
using Value = tl::expected<std::int32_t, std::string>;

constexpr std::string_view lead = "print "; ///< `print` accepts several conditions in a row

class Evaluator {
public:
  Evaluator(const structured::Program& program, const Meaning& meaning)
      : program_(program), meaning_(meaning) {}

  Value value(std::uint32_t n) const {
    const auto& node = program_.nodes[n];
    switch (node.kind) {
    case NodeKind::Number:
    case NodeKind::Duration: return node.value;
    case NodeKind::Name: return variable(name_of(node));
    case NodeKind::System: return meaning_.sensor(static_cast<spec::Variable>(node.what));
    case NodeKind::Element: return element(node, n);
    case NodeKind::Call:
      return tl::unexpected(fmt::format(
          "`{}` is a function of the program; only the program can call it", name_of(node)));
    case NodeKind::Builtin: return builtin(node, n);
    case NodeKind::Negate:
      return value(n - 1).map([](std::int32_t v) { return bytecode::subtract(0, v); });
    case NodeKind::Not: return value(n - 1).map([](std::int32_t v) { return v == 0 ? 1 : 0; });
    case NodeKind::And:
    case NodeKind::Or:
    case NodeKind::Least:
    case NodeKind::Greatest:
    case NodeKind::Binary:
    case NodeKind::Relation: return pair(node, n);
    }
    return 0;
  }

private:
  std::string_view name_of(const Node& node) const {
    return program_.name(static_cast<std::uint32_t>(node.value));
  }

  Value variable(std::string_view name) const {
    if (const auto found = meaning_.variable(name))
      return *found;
    return tl::unexpected(meaning_.missing(name));
  }

  Value element(const Node& node, std::uint32_t n) const {
    const auto index = value(n - 1);
    if (!index)
      return index;
    if (const auto found = meaning_.element(name_of(node), *index))
      return *found;
    return tl::unexpected(fmt::format("there is no `{}[{}]`", name_of(node), *index));
  }

  Value builtin(const Node& node, std::uint32_t n) const {
    const auto operand = value(n - 1);
    if (!operand)
      return operand;
    switch (static_cast<spec::Function>(node.what)) {
    case spec::Function::Abs: return bytecode::absolute(*operand);
    case spec::Function::Sqrt:
      if (*operand < 0)
        return tl::unexpected(std::string("`sqrt` of a negative number"));
      return static_cast<std::int32_t>(std::sqrt(static_cast<double>(*operand)));
    case spec::Function::Rnd:
      return tl::unexpected(
          std::string("`rnd` would use up a random number meant for the program"));
    }
    return 0;
  }

  Value pair(const Node& node, std::uint32_t n) const {
    const auto left = value(program_.nodes[n - 1].first - 1);
    if (!left)
      return left;
    if (node.kind == NodeKind::And && *left == 0)
      return 0;
    if (node.kind == NodeKind::Or && *left != 0)
      return 1;
    const auto right = value(n - 1);
    if (!right)
      return right;
    if (node.kind == NodeKind::Relation)
      return holds(static_cast<structured::Comparison>(node.what), *left, *right) ? 1 : 0;
    if (node.kind == NodeKind::Binary)
      return binary(static_cast<spec::Operator>(node.what), *left, *right);
    if (node.kind == NodeKind::Least || node.kind == NodeKind::Greatest)
      return node.kind == NodeKind::Least ? std::min(*left, *right) : std::max(*left, *right);
    return *right != 0 ? 1 : 0;
  }

  static bool holds(structured::Comparison comparison, std::int32_t a, std::int32_t b) {
    switch (comparison) {
    case structured::Comparison::Equal: return a == b;
    case structured::Comparison::NotEqual: return a != b;
    case structured::Comparison::Less: return a < b;
    case structured::Comparison::Greater: return a > b;
    case structured::Comparison::LessEqual: return a <= b;
    case structured::Comparison::GreaterEqual: return a >= b;
    }
    return false;
  }

  static Value binary(spec::Operator op, std::int32_t a, std::int32_t b) {
    if (const auto value = bytecode::calculate(op, a, b))
      return *value;
    return tl::unexpected(b == 0 ? std::string("division by zero")
                                 : fmt::format("cannot shift by {} bits", b));
  }

  const structured::Program& program_;
  const Meaning& meaning_;
};

} // namespace

tl::expected<Expression, std::string> Expression::parse(std::string_view text) {
  text = trim(text);
  if (text.empty())
    return tl::unexpected(std::string("missing expression"));
  Expression expression;
  expression.text_ = text;
  auto program = std::make_shared<structured::Program>();
  structured::parse(*program, "expression", "", fmt::format("{}{}\n", lead, text));
  const auto wrong =
      std::find_if(program->diagnostics.begin(), program->diagnostics.end(), is_error);
  if (wrong != program->diagnostics.end())
    return tl::unexpected(in_one_line(*wrong));
  const bool is_one = program->statements.size() == 1 &&
                      program->statements.front().kind == structured::Kind::Print &&
                      !program->items_of(program->statements.front()).empty();
  if (!is_one)
    return tl::unexpected(fmt::format("invalid expression `{}`", text));
  const auto items = program->items_of(program->statements.front());
  const auto& item = items.front();
  const bool is_whole = items.size() == 1 && !text.ends_with(',') && !text.ends_with(';') &&
                        text.find('\'') == std::string_view::npos;
  if (item.kind != structured::ItemKind::Expression || !is_whole)
    return tl::unexpected(fmt::format("`{}` is more than one expression", text));
  expression.root_ = item.value;
  expression.program_ = std::move(program);
  return expression;
}

std::vector<std::string_view> Expression::names() const {
  std::vector<std::string_view> all;
  for (const auto& node : program_->nodes)
    if (node.kind == NodeKind::Name || node.kind == NodeKind::Element)
      all.push_back(program_->name(static_cast<std::uint32_t>(node.value)));
  return all;
}

Value Expression::value(const Meaning& meaning) const {
  return Evaluator(*program_, meaning).value(root_);
}

} // namespace orb::debug
