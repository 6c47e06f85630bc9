#include "base/text/text.h"
#include "structured/meaning/checker.h"

namespace orb::structured {

// What variables add up to, and is lost on the way: compiler/lint/lint_sums.cpp is the same for
// numbered programs.

std::optional<compiler::Bound> Checker::bound_of(std::uint32_t relation) const {
  if (program_.nodes[relation].kind != NodeKind::Relation) // else there may be nothing before it
    return std::nullopt;
  const auto number = evaluate(program_, names_, relation - 1);
  if (!number)
    return std::nullopt;
  const std::int64_t value = number->value;
  switch (static_cast<Comparison>(program_.nodes[relation].what)) {
  case Comparison::Equal: return compiler::Bound{spec::Relation::Equal, value};
  case Comparison::NotEqual: return compiler::Bound{spec::Relation::NotEqual, value};
  case Comparison::Less: return compiler::Bound{spec::Relation::Less, value};
  case Comparison::Greater: return compiler::Bound{spec::Relation::Greater, value};
  case Comparison::LessEqual: return compiler::Bound{spec::Relation::Less, value + 1};
  case Comparison::GreaterEqual: return compiler::Bound{spec::Relation::Greater, value - 1};
  }
  return std::nullopt;
}

void Checker::check_joint(std::uint32_t n) {
  const auto& nodes = program_.nodes;
  const auto right = n - 1;
  const auto left = program_.before(right);
  const auto first = bound_of(left);
  const auto second = bound_of(right);
  if (!first || !second)
    return;
  const auto asked = program_.before(left - 1);
  const auto again = program_.before(right - 1);
  const auto& one = nodes[asked];
  const bool cleared =
      one.kind == NodeKind::System &&
      spec::info(static_cast<spec::Variable>(one.what)).access == spec::Access::ReadClears;
  if (cleared || (one.kind != NodeKind::Name && one.kind != NodeKind::System) ||
      !equal_words(program_.text_of(one.span), program_.text_of(nodes[again].span)))
    return;
  const bool both = nodes[n].kind == NodeKind::And;
  const auto answer = compiler::joint_answer(*first, *second, both);
  const Span all{nodes[left].span.begin, nodes[right].span.end};
  const auto between =
      std::string(program_.text_of({nodes[left].span.end, nodes[right].span.begin}));
  const auto joint = between.find(both ? "and" : "or");
  if (!answer || joint == std::string::npos)
    return;
  const auto begin = nodes[left].span.end + static_cast<std::uint32_t>(joint);
  const Span word{begin, begin + (both ? 3U : 2U)};
  const auto* const other = both ? "or" : "and";
  const auto line = fmt::format("{}{}{}", program_.text_of({all.begin, word.begin}), other,
                                program_.text_of({word.end, all.end}));
  auto& d = report(compiler::rules::ConstantComparison, all,
                   compiler::one_answer(program_.text_of(all), *answer, line));
  d.fix = Fix{d.help, {{word, other}}, Safety::Unsafe};
}

void Checker::check_share(std::uint32_t n) {
  const auto& nodes = program_.nodes;
  constexpr std::int32_t per_cent = 100; // of a whole
  const auto is = [&](std::uint32_t node, spec::Operator sign) {
    return nodes[node].kind == NodeKind::Binary &&
           static_cast<spec::Operator>(nodes[node].what) == sign;
  };
  if (!is(n, spec::Operator::Multiply) || nodes[n - 1].kind != NodeKind::Number ||
      nodes[n - 1].value != per_cent)
    return;
  const auto quotient = program_.before(n - 1);
  if (!is(quotient, spec::Operator::Divide))
    return;
  const auto divisor = evaluate(program_, names_, quotient - 1);
  if (!divisor || divisor->value < 2 || divisor->value % per_cent == 0)
    return;
  const auto dividend = program_.before(quotient - 1);
  const auto slash = program_.text.find('/', nodes[dividend].span.end);
  if (slash == std::string::npos || slash > nodes[quotient - 1].span.begin)
    return;
  const auto line =
      fmt::format("{} * {} / {}",
                  trim(program_.text_of({nodes[n].span.begin, static_cast<std::uint32_t>(slash)})),
                  per_cent, program_.text_of(nodes[quotient - 1].span));
  auto& d = report(compiler::rules::DividesFirst, nodes[n].span,
                   compiler::divides_first(program_.text_of(nodes[n].span), line));
  d.fix = Fix{texts::Write(line), {{nodes[n].span, line}}, Safety::Unsafe};
}

std::uint32_t Checker::set_by(const Statement& statement) const {
  return statement.kind == Kind::Assign ? names_.of_node[item(statement, 0).value] : none;
}

void Checker::check_exchange(std::uint32_t i) {
  const auto reads_only = [&](const Statement& statement) {
    const auto& node = program_.nodes[item(statement, 1).value];
    return statement.operation == Statement::none_operation && node.kind == NodeKind::Name
               ? names_.of_node[item(statement, 1).value]
               : none;
  };
  const auto is_name = [&](const Statement& statement) {
    return program_.nodes[item(statement, 0).value].kind == NodeKind::Name;
  };
  if (i + 1 >= program_.statements.size() || at(i).kind != Kind::Assign ||
      at(i + 1).kind != Kind::Assign || at(i).depth != at(i + 1).depth)
    return;
  const auto first = set_by(at(i));
  const auto second = set_by(at(i + 1));
  if (first == none || second == none || first == second || !is_name(at(i)) ||
      !is_name(at(i + 1)) || reads_only(at(i)) != second || reads_only(at(i + 1)) != first)
    return;
  const auto a = program_.name(names_.symbols[first].name);
  const auto b = program_.name(names_.symbols[second].name);
  report(compiler::rules::LostExchange, at(i).span, compiler::lost_exchange(a, b, "kept"));
}

void Checker::check_single_round(std::uint32_t i) {
  auto last = none;
  for (auto n = i + 1; n < at(i).next; ++n) {
    if (at(n).kind == Kind::Continue || at(n).kind == Kind::Label)
      return;
    if (at(n).depth == at(i).depth + 1)
      last = n;
  }
  if (last == none || at(last).kind != Kind::Exit || size(at(last)) > 0 || last == i + 1)
    return;
  report(compiler::rules::LoopRunsOnce, at(last).span, texts::AlwaysEnds(),
         texts::MakeConditional("if speed = 0 then exit"));
}

void Checker::check_products() {
  std::vector<const Statement*> product(names_.symbols.size());
  std::vector<bool> others(names_.symbols.size());
  for (const auto& statement : program_.statements)
    for (const auto& part : program_.items_of(statement)) {
      const auto symbol = part.kind == ItemKind::Place ? names_.of_node[part.value] : none;
      if (symbol == none)
        continue;
      if (product[symbol] == nullptr && multiplies(statement, symbol))
        product[symbol] = &statement;
      else if (!multiplies(statement, symbol))
        others[symbol] = true;
    }
  for (std::size_t symbol = 0; symbol < product.size(); ++symbol)
    if (product[symbol] != nullptr && !others[symbol] &&
        names_.symbols[symbol].kind == SymbolKind::Variable)
      report(compiler::rules::StaysZero, product[symbol]->span,
             compiler::stays_zero(program_.name(names_.symbols[symbol].name)));
}

bool Checker::multiplies(const Statement& statement, std::uint32_t symbol) const {
  if (statement.kind != Kind::Assign)
    return false;
  if (statement.operation != Statement::none_operation)
    return static_cast<spec::Operator>(statement.operation) == spec::Operator::Multiply;
  const auto root = item(statement, 1).value;
  const auto& node = program_.nodes[root];
  const auto is_own = [&](std::uint32_t n) {
    return program_.nodes[n].kind == NodeKind::Name && names_.of_node[n] == symbol;
  };
  return node.kind == NodeKind::Binary &&
         static_cast<spec::Operator>(node.what) == spec::Operator::Multiply &&
         (is_own(node.first) || is_own(root - 1));
}

void Checker::check_restart(std::uint32_t i) {
  const auto& loop = at(i);
  for (auto n = i + 1; n < loop.next; ++n) {
    const auto symbol = at(n).depth == loop.depth + 1 ? set_by(at(n)) : none;
    if (symbol == none || at(n).operation != Statement::none_operation ||
        program_.nodes[item(at(n), 0).value].kind != NodeKind::Name || !value_of(item(at(n), 1)))
      continue;
    for (auto m = n + 1; m < loop.next; ++m)
      if (at(m).depth == loop.depth + 1 && set_by(at(m)) == symbol) {
        if (adds_to(at(m), symbol) && is_read_below(loop.next, symbol))
          report(compiler::rules::SumRestarts, at(n).span,
                 compiler::sum_restarts(
                     program_.name(names_.symbols[symbol].name),
                     compiler::texts::WriteAboveLoop(program_.text_of(at(n).span))));
        break;
      }
  }
}

bool Checker::adds_to(const Statement& statement, std::uint32_t symbol) const {
  if (statement.operation != Statement::none_operation)
    return true;
  const auto& node = program_.nodes[item(statement, 1).value];
  return node.kind == NodeKind::Binary && program_.nodes[node.first].kind == NodeKind::Name &&
         names_.of_node[node.first] == symbol;
}

bool Checker::is_read_below(std::uint32_t statement, std::uint32_t symbol) const {
  for (auto n = statement + 1; n < program_.statements.size(); ++n) {
    for (const auto& part : program_.items_of(at(n)))
      if (part.kind == ItemKind::Expression)
        for (auto node = program_.nodes[part.value].first; node <= part.value; ++node)
          if (program_.nodes[node].kind == NodeKind::Name && names_.of_node[node] == symbol)
            return true;
    if (set_by(at(n)) == symbol && at(n).operation == Statement::none_operation)
      return false;
  }
  return false;
}

} // namespace orb::structured
