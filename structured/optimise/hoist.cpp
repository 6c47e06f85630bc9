#include "structured/optimise/hoist.h"

#include "structured/analyse/flow.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace orb::structured {
namespace {

class Hoister {
public:
  explicit Hoister(Code& code) : code_(code) {}

  bool run() {
    constexpr int most_rounds = 32;
    int round = 0;
    while (round < most_rounds && once())
      ++round;
    return round > 0;
  }

private:
  /// Lines that do nothing but set a variable or two, or one to one of two values: `v = a`, or `if
  /// c goto M; v = a; goto L` with `M: v = b; goto L` somewhere. The robot has one line for them.
  struct Arm {
    std::uint32_t begin = none;
    std::uint32_t last = none;        ///< line that sets one
    std::uint32_t target = none;      ///< a label: where it goes on
    std::uint32_t end = none;         ///< the line of that label, or a jump to it
    std::uint32_t alternative = none; ///< `M:`
    bool is_choice() const { return alternative != none; }
  };

  bool once() {
    named_ = tidy(code_);
    at_ = lines_of_labels(code_);
    const auto flow = read_flow(code_);
    const auto liveness = read_liveness(code_, flow);
    for (std::uint32_t b = 0; b + 1 < flow.blocks.size(); ++b) {
      const auto i = flow.blocks[b].end - 1;
      const auto& line = code_.lines[i];
      const auto other = line.kind == LineKind::If ? flow.block_of_label[line.label] : none;
      if (other == none || line.guard)
        continue;
      const auto below = arm_at(i + 1);
      const auto there = taken_arm(line.label);
      if (below && there && below->target == there->target && !below->is_choice() &&
          !there->is_choice() && below->begin == below->last && there->begin == there->last)
        continue; // `if … then v = a else v = b`
      if (below && fits(i, *below, liveness.in[other]) && hoist(i, *below, line.label))
        return true;
      if (there && fits(i, *there, liveness.in[b + 1]) && hoist(i, *there, there->target))
        return true;
    }
    return false;
  }

  /// The arm that only a test leads to.
  std::optional<Arm> taken_arm(std::uint32_t label) const {
    return only_jump_leads_to(code_, named_, at_, label) ? arm_at(at_[label] + 1) : std::nullopt;
  }

  bool sets(std::uint32_t i) const {
    if (i + 1 >= code_.lines.size())
      return false;
    const auto& line = code_.lines[i];
    return line.kind == LineKind::Let && !line.guard && line.variable != index_variable &&
           !code_.variables[line.variable].kept && is_pure(effects_of(code_, line));
  }

  /// The label that a line stands for or jumps to, or none.
  std::uint32_t label_at(std::uint32_t i) const {
    const auto& line = code_.lines[i];
    return line.kind == LineKind::Goto || line.kind == LineKind::Label ? line.label : none;
  }

  std::optional<Arm> arm_at(std::uint32_t begin) const {
    Arm arm;
    arm.begin = begin;
    const auto& first = code_.lines[std::min<std::size_t>(begin, code_.lines.size() - 1)];
    const bool choice = first.kind == LineKind::If && !first.guard &&
                        is_pure(effects_of(code_, first)) &&
                        only_jump_leads_to(code_, named_, at_, first.label);
    const auto set = choice ? begin + 1 : begin;
    if (!sets(set))
      return std::nullopt;
    arm.last = choice || !sets(set + 1) ? set : set + 1;
    arm.end = arm.last + 1;
    arm.target = label_at(arm.end);
    if (arm.target == none)
      return std::nullopt;
    if (!choice)
      return arm;
    arm.alternative = at_[first.label];
    const auto other = arm.alternative + 1;
    const bool alike = sets(other) && code_.lines[other].variable == code_.lines[set].variable &&
                       label_at(other + 1) == arm.target && arm.target != first.label;
    return alike ? std::optional(arm) : std::nullopt;
  }

  /// Whether an arm can run before test `i`, if these variables are needed on the other way.
  bool fits(std::uint32_t i, const Arm& arm, std::span<const std::uint64_t> needed) const {
    bool good = true;
    for (auto n = arm.is_choice() ? arm.last : arm.begin; n <= arm.last; ++n) {
      const auto set = code_.lines[n].variable;
      good = good && !contains(needed, set);
      each_line_read(code_, code_.lines[i], [&](std::uint32_t v) { good = good && v != set; });
    }
    return good;
  }

  /// Runs an arm before test `i`, which then leads to `label`; false, with all as it was, where
  /// that takes no line less.
  bool hoist(std::uint32_t i, const Arm& arm, std::uint32_t label) {
    const auto before = code_.lines;
    code_.lines[i].label = label;
    std::vector<CodeLine> lines;
    const auto take = [&](std::uint32_t n) {
      lines.push_back(code_.lines[n]);
      code_.lines[n].kind = LineKind::Nothing;
    };
    if (arm.is_choice()) {
      take(arm.begin);
      take(arm.begin + 1);
      auto jump = lines.back();
      jump.kind = LineKind::Goto;
      jump.label = code_.labels++;
      lines.push_back(jump);
      take(arm.alternative);
      take(arm.alternative + 1);
      jump.kind = LineKind::Label;
      lines.push_back(jump);
    } else {
      for (auto n = arm.begin; n <= arm.last; ++n)
        take(n);
    }
    code_.lines.insert(code_.lines.begin() + i, lines.begin(), lines.end());
    clean_jumps(code_);
    straighten(code_);
    clean_jumps(code_);
    if (lines_that_act(code_.lines) < lines_that_act(before))
      return true;
    code_.lines = before;
    return false;
  }

  static std::size_t lines_that_act(const std::vector<CodeLine>& lines) {
    return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [](const auto& line) {
      return line.kind != LineKind::Label && line.kind != LineKind::Nothing;
    }));
  }

  Code& code_;
  std::vector<std::uint32_t> at_;    ///< of each label: its line
  std::vector<std::uint32_t> named_; ///< of each label: how often
};

} // namespace

bool hoist_arms(Code& code) {
  return Hoister(code).run();
}

} // namespace orb::structured
