#include "compiler/lint/values_pass.h"

namespace orb::compiler {

void ValuesPass::run() {
  collect_letters();
  check_lines();
  check_letters();
}

bool ValuesPass::may_say_more() {
  following_ = true; // computes anew
  for (std::uint32_t i = 0; i < program_.letters; ++i)
    now_.ranges[i] = given_[i].value_or(Range{});
  const auto most = spec::value_of(spec::Limit::IndexedVariables);
  const auto& index = given_[index_letter];
  if (index_doubt_ && index && (index->lo < 1 || index->hi > most))
    return true;
  if (std::any_of(questions_.begin(), questions_.end(), [&](const Question& question) {
        const auto& given = given_[question.letter];
        return given && !given->constant() && !given->has(question.number);
      }))
    return true;
  return std::any_of(doubts_.begin(), doubts_.end(), [&](const Doubt& doubt) {
    compute(program_.nodes[doubt.root].first, doubt.root + 1);
    const auto& range = known_[doubt.root].range;
    return range != Range{} && (range.lo < doubt.least || range.hi > doubt.greatest);
  });
}

void ValuesPass::run_followed() {
  collect_letters();
  if (ways_.prepare())
    follow();
  check_lines();
  check_letters();
}

void lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings) {
  auto& all = findings.all();
  const auto before = static_cast<std::ptrdiff_t>(all.size());
  ValuesPass straight(program, flow, target, findings);
  straight.run();
  if (jumps == Jumps::Unknown || !straight.may_say_more())
    return;
  all.erase(all.begin() + before, all.end());
  ValuesPass(program, flow, target, findings).run_followed();
}

} // namespace orb::compiler
