#include "base/text/text.h"
#include "structured/meaning/checker.h"

namespace orb::structured {

std::optional<compiler::Bound> Checker::bound_of(std::uint32_t relation) const {
  if (program_.nodes[relation].kind != NodeKind::Relation) // otherwise nothing may precede it
    return std::nullopt;
  const auto number = evaluate(program_, names_, relation - 1);
  if (!number)
    return std::nullopt;
  return compiler::Bound{static_cast<Comparison>(program_.nodes[relation].what), number->value};
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

} // namespace orb::structured
