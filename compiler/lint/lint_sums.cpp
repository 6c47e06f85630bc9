#include "compiler/lint/line_pass.h"
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

/// Finds computations that lose their result: swaps, sums, products and percentages.
class SumsPass : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    for (const auto& place : flow_.all(Statement::If))
      check_joint(program_.as<IfView>(program_.statements[place.statement]));
    for (const auto& place : flow_.all(Statement::Let))
      check_let(program_.statements[place.statement], place.code);
    for (const auto& statement : program_.statements)
      if (!statement.error)
        for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n)
          check_share(n), check_mean(n);
    check_loops();
    check_products();
  }

private:
  /// The letter that a statement assigns; nothing for any other statement.
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
  std::string_view name_in(const StatementNode& let) const {
    return program_.text_of(program_.as<LetView>(let).variable.span);
  }

  void check_let(const StatementNode& let, std::uint32_t code) {
    if (!set_by(let))
      return;
    note_product(let);
    if (const auto letter = letter_in(program_, value_of(let));
        letter && &let == &statement_of(code))
      check_exchange(code, *letter);
  }

  // ---- two comparisons of one letter or sensor

  std::optional<Bound> bound_of(const Comparison& comparison) const {
    const auto number = constant_in(program_, comparison.right);
    if (!number)
      return std::nullopt;
    return Bound{orders_of(comparison), *number};
  }

  void check_joint(const IfView& condition) {
    if (!condition.second || program_.text_of(condition.first.left.span) !=
                                 program_.text_of(condition.second->left.span))
      return;
    const auto sensor = sensor_in(program_, condition.first.left);
    if (!sensor && !letter_in(program_, condition.first.left))
      return; // each `rnd 6` gives another value
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
    const auto said = one_answer(program_.text_of(all), *answer, line);
    auto& d = findings_.add(rules::ConstantComparison, all, said.message, said.help);
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
    const auto a = name_in(statement_of(i));
    const auto b = name_in(statement_of(i + 1));
    const auto kept = free_name(); // for the old value
    findings_.add(rules::LostExchange, statement_of(i).span, texts::OldValueLost(a, b),
                  texts::SaveItFirst(fmt::format("{} = {}", kept, a), fmt::format("{} = {}", a, b),
                                     fmt::format("{} = {}", b, kept)));
  }

  std::string free_name() const {
    if (program_.letters > spec::letter_count)
      return "kept";
    std::array<bool, most_letters> used{};
    for (const auto& node : program_.nodes)
      if (node.kind == NodeKind::Letter)
        used[node.what] = true;
    for (const auto& statement : program_.statements)
      if (const auto letter = set_by(statement))
        used[*letter] = true;
    const auto free = std::find(used.begin() + 2, used.end(), false); // from C on
    return {
        spec::letter_name(free == used.end() ? 2 : static_cast<std::size_t>(free - used.begin()))};
  }

  // ---- a percentage

  void check_share(std::uint32_t n) {
    constexpr std::int32_t per_cent = 100; // of a whole
    const auto& nodes = program_.nodes;
    const auto is = [&](std::uint32_t node, spec::Operator sign) {
      return nodes[node].kind == NodeKind::Binary &&
             static_cast<spec::Operator>(nodes[node].what) == sign;
    };
    if (!is(n, spec::Operator::Multiply) || nodes[n - 1].kind != NodeKind::Number ||
        nodes[n - 1].value != per_cent)
      return;
    const auto quotient = nodes[n - 1].first - 1;
    if (!is(quotient, spec::Operator::Divide))
      return;
    const auto& divisor = nodes[quotient - 1];
    if (divisor.kind != NodeKind::Number || divisor.overflow || divisor.value < 2 ||
        divisor.value % per_cent == 0)
      return;
    const auto& dividend = nodes[divisor.first - 1];
    const bool sum = dividend.kind == NodeKind::Binary &&
                     spec::operators[dividend.what].level == spec::Level::Low;
    const auto line =
        fmt::format("{}{}{} * {} / {}", sum ? "(" : "", program_.text_of(dividend.span),
                    sum ? ")" : "", per_cent, program_.text_of(divisor.span));
    const auto& span = nodes[n].span;
    findings_
        .add(rules::DividesFirst, span, texts::DiscardsRemainder(program_.text_of(span)),
             texts::MultiplyFirst(line))
        .fix = single_fix(texts::Write(line), span, line, Safety::Unsafe);
  }

  // ---- a mean of several

  /// `a + b + c / 3`, where the divisor equals the number of terms.
  void check_mean(std::uint32_t n) {
    const auto& nodes = program_.nodes;
    const auto is = [&](std::uint32_t node, spec::Operator sign) {
      return nodes[node].kind == NodeKind::Binary &&
             static_cast<spec::Operator>(nodes[node].what) == sign;
    };
    if (!is(n, spec::Operator::Add) || !is(n - 1, spec::Operator::Divide) ||
        nodes[n - 2].kind != NodeKind::Number)
      return;
    const auto& count = nodes[n - 2];
    const auto& last = nodes[count.first - 1];
    constexpr std::int32_t least = 3; // `x + width / 2` is a place
    std::int32_t found = last.kind == NodeKind::Letter ? 1 : 0;
    auto sum = nodes[n - 1].first - 1;
    for (; is(sum, spec::Operator::Add); sum = nodes[sum - 1].first - 1)
      found += nodes[sum - 1].kind == last.kind ? 1 : 0;
    found += nodes[sum].kind == last.kind ? 1 : 0;
    if (found < least || found != count.value)
      return;
    const auto& span = nodes[n].span;
    const auto line =
        fmt::format("({}) / {}", program_.text_of({span.begin, last.span.end}), found);
    findings_
        .add(rules::DividesFirst, span, texts::OnlyLastDivided(program_.text_of(last.span), found),
             texts::Write(line))
        .fix = single_fix(texts::Write(line), span, line, Safety::Unsafe);
  }

  // ---- a product that starts at 0

  void note_product(const StatementNode& let) {
    const auto letter = *set_by(let);
    const auto root = value_of(let).value;
    const auto& nodes = program_.nodes;
    if (nodes[root].kind == NodeKind::Number && nodes[root].value == 0)
      return; // it has this value anyway
    const auto is_own = [&](std::uint32_t n) {
      return nodes[n].kind == NodeKind::Letter && nodes[n].what == letter;
    };
    const bool product =
        nodes[root].kind == NodeKind::Binary &&
        static_cast<spec::Operator>(nodes[root].what) == spec::Operator::Multiply &&
        (is_own(root - 1) || is_own(nodes[root - 1].first - 1));
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
    for (const auto& product : products_)
      if (product.first != nullptr && !product.others)
        findings_.add(rules::StaysZero, product.first->span,
                      texts::StartsAtZero(name_in(*product.first)),
                      texts::SetAboveLoop(fmt::format("{} = 1", name_in(*product.first))));
  }

  // ---- a sum that restarts in each round

  void check_loops() {
    for (const auto& place : flow_.all(Statement::For))
      if (flow_.is_line(place))
        if (const auto next = next_of(place.code); next != none)
          check_sum(place.code + 1, next);
    for (const auto& jump : flow_.jumps)
      if (!jump.call && jump.to <= jump.from && jump.from - jump.to < longest_loop &&
          statement_of(jump.from).kind != Statement::On)
        check_sum(jump.to, jump.from);
  }

  /// The `next` of a loop, in text order.
  std::uint32_t next_of(std::uint32_t loop) const {
    std::uint32_t depth = 0;
    for (auto i = loop; i < flow_.code.size() && i - loop < longest_loop; ++i) {
      depth += statement_of(i).kind == Statement::For ? 1 : 0;
      if (statement_of(i).kind == Statement::Next && --depth == 0)
        return i;
    }
    return none;
  }

  /// Checks a loop from its first line to the line that jumps back.
  void check_sum(std::uint32_t first, std::uint32_t last) {
    std::uint32_t depth = 0;
    const StatementNode* restart = nullptr;
    for (auto i = first; i < last; ++i) {
      const auto& statement = statement_of(i);
      if (statement.error || (flow_.code[i].target && i > first) ||
          !flow_.jumps_of(flow_.code[i]).empty() || statement.then_branch != none)
        return; // a line that runs only in some rounds
      depth += statement.kind == Statement::For ? 1 : 0;
      depth -= statement.kind == Statement::Next ? 1 : 0;
      const auto letter = set_by(statement);
      if (!letter || depth > 0)
        continue;
      if (restart == nullptr && number_in(program_, value_of(statement)))
        restart = &statement;
      else if (restart != nullptr && set_by(*restart) == letter && adds_to(statement, *letter) &&
               is_read_below(last, *letter))
        return add_restart(*restart);
    }
  }

  bool adds_to(const StatementNode& let, std::uint8_t letter) const {
    const auto nodes = nodes_of(program_, value_of(let));
    return nodes.size() > 2 && nodes.back().kind == NodeKind::Binary &&
           nodes.front().kind == NodeKind::Letter && nodes.front().what == letter;
  }

  /// True if the letter is read below a loop before it is assigned there.
  bool is_read_below(std::uint32_t last, std::uint8_t letter) const {
    for (auto i = last + 1; i < flow_.code.size(); ++i) {
      const auto& statement = statement_of(i);
      if (statement.error)
        return false;
      if (reads(statement, letter))
        return true;
      if (set_by(statement) == letter)
        return false;
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

  void add_restart(const StatementNode& restart) {
    findings_.add(rules::SumRestarts, restart.span, texts::ResetInEveryIteration(name_in(restart)),
                  texts::WriteAboveLoop(program_.text_of(restart.span)));
  }

  struct Product {
    const StatementNode* first = nullptr;
    bool others = false; ///< something else assigns it, too
  };

  std::array<Product, most_letters> products_{};
};

} // namespace

void lint_sums(const Program& program, const Flow& flow, Findings& findings) {
  SumsPass(program, flow, findings).run();
}

} // namespace orb::compiler
