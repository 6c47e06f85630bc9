#include "compiler/lint/lint_passes.h"
#include "compiler/lint/reading.h"
#include "compiler/lint/sums.h"
#include "compiler/text/rules.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace orb::compiler {
namespace {

using spec::Statement;

/// What letters add up to, and is lost on the way: values that are exchanged, sums, products and
/// shares.
class SumsPass {
public:
  SumsPass(const Program& program, const Flow& flow, Findings& findings)
      : program_(program), flow_(flow), findings_(findings) {}

  void run() {
    for (const auto& place : flow_.all(Statement::If))
      check_joint(program_.as<IfView>(program_.statements[place.statement]));
    for (const auto& place : flow_.all(Statement::Let))
      check_let(program_.statements[place.statement], place.code);
    for (const auto& place : flow_.all(Statement::For))
      if (flow_.is_line(place))
        check_sum(place.code);
    check_products();
  }

private:
  const StatementNode& statement_of(std::uint32_t code) const {
    return program_.statements[flow_.code[code].statement];
  }

  /// The letter that a statement sets; nothing of any other one.
  std::optional<std::uint8_t> set_by(const StatementNode& statement) const {
    if (statement.error || statement.kind != Statement::Let)
      return std::nullopt;
    const auto let = program_.as<LetView>(statement);
    return let.variable.kind == ItemKind::Letter
               ? std::optional(static_cast<std::uint8_t>(let.variable.value))
               : std::nullopt;
  }
  const Item& value_of(const StatementNode& let) const {
    return program_.as<LetView>(let).expression;
  }
  static std::string name_of(std::uint8_t letter) { return {static_cast<char>('A' + letter)}; }

  void check_let(const StatementNode& let, std::uint32_t code) {
    if (!set_by(let))
      return;
    note_product(let);
    check_share(value_of(let));
    if (const auto letter = letter_in(program_, value_of(let));
        letter && &let == &statement_of(code))
      check_exchange(code, *letter);
  }

  // ---- two comparisons of one letter or sensor

  std::optional<Bound> bound_of(const Comparison& comparison) const {
    const auto& right = comparison.right;
    auto number = number_in(program_, right);
    const auto nodes = nodes_of(program_, right); // `0 - 80`
    if (!number && nodes.size() == 3 && nodes[0].kind == NodeKind::Number && nodes[0].value == 0 &&
        nodes[1].kind == NodeKind::Number && nodes[2].kind == NodeKind::Binary &&
        static_cast<spec::Operator>(nodes[2].what) == spec::Operator::Subtract)
      number = -nodes[1].value;
    if (!number)
      return std::nullopt;
    return Bound{static_cast<spec::Relation>(comparison.relation.value), *number};
  }

  void check_joint(const IfView& condition) {
    if (!condition.second || program_.text_of(condition.first.left.span) !=
                                 program_.text_of(condition.second->left.span))
      return;
    const auto sensor = sensor_in(program_, condition.first.left);
    if (!sensor && !letter_in(program_, condition.first.left))
      return; // `rnd 6` is another one each time
    const auto first = bound_of(condition.first);
    const auto second = bound_of(*condition.second);
    const bool both = condition.joint->kind == ItemKind::And;
    if (!first || !second || (sensor && spec::info(*sensor).access == spec::Access::ReadClears))
      return;
    const auto answer = joint_answer(*first, *second, both);
    if (!answer)
      return;
    const Span all{condition.first.left.span.begin, condition.second->right.span.end};
    const auto joint = condition.joint->span;
    const auto line = fmt::format("{}{}{}", program_.text_of({all.begin, joint.begin}),
                                  both ? "or" : "and", program_.text_of({joint.end, all.end}));
    auto& d = add(rules::ConstantComparison, all, one_answer(program_.text_of(all), *answer, line));
    d.fix = single_fix(d.help, joint, both ? "or" : "and", Safety::Unsafe);
  }

  // ---- A = B, then B = A

  void check_exchange(std::uint32_t i, std::uint8_t second) {
    if (i + 1 == flow_.code.size() || flow_.code[i + 1].target)
      return;
    const auto first = set_by(statement_of(i));
    if (first == second || set_by(statement_of(i + 1)) != second ||
        letter_in(program_, value_of(statement_of(i + 1))) != first)
      return;
    add(rules::LostExchange, statement_of(i).span,
        lost_exchange(name_of(*first), name_of(second), free_letter()));
  }

  std::string free_letter() const {
    std::array<bool, spec::letter_count> used{};
    for (const auto& node : program_.nodes)
      if (node.kind == NodeKind::Letter)
        used[node.what] = true;
    for (const auto& statement : program_.statements)
      if (const auto letter = set_by(statement))
        used[*letter] = true;
    const auto free = std::find(used.begin() + 2, used.end(), false); // from C on
    return name_of(static_cast<std::uint8_t>(free == used.end() ? 2 : free - used.begin()));
  }

  // ---- a share of 100

  void check_share(const Item& value) {
    const auto nodes = nodes_of(program_, value);
    constexpr std::int32_t per_cent = 100; // of a whole
    const auto last = nodes.size() - 1;    // dividend, divisor, `/`, 100, `*`
    const auto is = [&](std::size_t node, spec::Operator sign) {
      return nodes[node].kind == NodeKind::Binary &&
             static_cast<spec::Operator>(nodes[node].what) == sign;
    };
    const auto is_number = [&](std::size_t node) { return nodes[node].kind == NodeKind::Number; };
    if (nodes.size() < 5 || !is(last, spec::Operator::Multiply) || !is_number(last - 1) ||
        nodes[last - 1].value != per_cent || !is(last - 2, spec::Operator::Divide) ||
        !is_number(last - 3) || nodes[last - 3].value < 2 || nodes[last - 3].value % per_cent == 0)
      return;
    const auto line =
        fmt::format("{} * {} / {}", program_.text_of({value.span.begin, nodes[last - 4].span.end}),
                    per_cent, nodes[last - 3].value);
    add(rules::DividesFirst, value.span, divides_first(program_.text_of(value.span), line)).fix =
        single_fix(texts::Write(line), value.span, line, Safety::Unsafe);
  }

  // ---- a product that begins at 0

  void note_product(const StatementNode& let) {
    const auto letter = *set_by(let);
    const auto nodes = nodes_of(program_, value_of(let));
    const auto is_own = [&](const Node& node) {
      return node.kind == NodeKind::Letter && node.what == letter;
    };
    const bool product =
        nodes.size() > 2 && nodes.back().kind == NodeKind::Binary &&
        static_cast<spec::Operator>(nodes.back().what) == spec::Operator::Multiply &&
        (is_own(nodes.front()) || is_own(nodes[nodes.size() - 2])) && nodes.size() == 3;
    auto& known = products_[letter];
    known.others = known.others || !product;
    if (product && known.first == nullptr)
      known.first = &let;
  }

  void check_products() {
    for (const auto kind : {Statement::For, Statement::Read, Statement::Input})
      for (const auto& place : flow_.all(kind))
        for (const auto& item : program_.items_of(program_.statements[place.statement]))
          if (item.kind == ItemKind::Letter)
            products_[item.value].others = true;
    for (std::size_t i = 0; i < products_.size(); ++i) {
      if (products_[i].first == nullptr || products_[i].others || program_.lines.empty())
        continue;
      add(rules::StaysZero, products_[i].first->span,
          stays_zero(name_of(static_cast<std::uint8_t>(i))));
    }
  }

  // ---- a sum that begins anew in each round

  void check_sum(std::uint32_t loop) {
    const auto counter = program_.as<ForView>(statement_of(loop)).variable.value;
    std::uint32_t depth = 0;
    const StatementNode* restart = nullptr;
    for (auto i = loop + 1; i < flow_.code.size(); ++i) {
      const auto& statement = statement_of(i);
      if (statement.error || flow_.code[i].target || statement.kind == Statement::If)
        return;
      if (statement.kind == Statement::Next && depth == 0)
        return;
      depth += statement.kind == Statement::For ? 1 : 0;
      depth -= statement.kind == Statement::Next ? 1 : 0;
      const auto letter = set_by(statement);
      if (!letter || depth > 0 || *letter == counter)
        continue;
      if (restart == nullptr && number_in(program_, value_of(statement)))
        restart = &statement;
      else if (restart != nullptr && set_by(*restart) == letter && adds_to(statement, *letter) &&
               is_read_after_loop(i, *letter))
        return add_restart(*restart, *letter);
    }
  }

  bool adds_to(const StatementNode& let, std::uint8_t letter) const {
    const auto nodes = nodes_of(program_, value_of(let));
    return nodes.size() > 2 && nodes.back().kind == NodeKind::Binary &&
           nodes.front().kind == NodeKind::Letter && nodes.front().what == letter;
  }

  /// Whether what is read below the loop's `next` is that letter, before it is set there.
  bool is_read_after_loop(std::uint32_t from, std::uint8_t letter) const {
    std::uint32_t depth = 0;
    bool below = false;
    for (auto i = from; i < flow_.code.size(); ++i) {
      const auto& statement = statement_of(i);
      if (statement.error)
        return false;
      if (below && reads(statement, letter))
        return true;
      if (below && set_by(statement) == letter)
        return false;
      if (!below && statement.kind == Statement::Next && depth-- == 0)
        below = true;
      depth += statement.kind == Statement::For ? 1 : 0;
    }
    return false;
  }

  bool reads(const StatementNode& statement, std::uint8_t letter) const {
    for (const auto& item : program_.items_of(statement))
      for (const auto& node : nodes_of(program_, item))
        if (node.kind == NodeKind::Letter && node.what == letter)
          return true;
    return false;
  }

  void add_restart(const StatementNode& restart, std::uint8_t letter) {
    add(rules::SumRestarts, restart.span,
        sum_restarts(name_of(letter), texts::WriteAboveFor(program_.text_of(restart.span))));
  }

  Diagnostic& add(const Rule& rule, Span span, Said said) {
    return findings_.add(rule, span, std::move(said.message), std::move(said.help));
  }

  struct Product {
    const StatementNode* first = nullptr;
    bool others = false; ///< something else sets it, too
  };

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::array<Product, most_letters> products_{};
};

} // namespace

void lint_sums(const Program& program, const Flow& flow, Findings& findings) {
  SumsPass(program, flow, findings).run();
}

} // namespace orb::compiler
