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
    bool any = round > 0;
    for (std::uint32_t r = 1; r < code_.routines.size(); ++r)
      any = (code_.routines[r] != none && begin_with_result(r)) || any;
    return any;
  }

private:
  /// Lines that do nothing but set a variable, perhaps to one of two values: `v = a`, or `if c goto
  /// M; v = a; goto L` with `M: v = b; goto L` somewhere. The robot has one line for them.
  struct Arm {
    std::uint32_t begin = none;
    std::uint32_t variable = none;
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
          !there->is_choice())
        continue; // `if … then v = a else v = b`
      if (below && fits(i, *below, liveness.in[other]) && hoist(i, *below, line.label))
        return true;
      if (there && fits(i, *there, liveness.in[b + 1]) && hoist(i, *there, there->target))
        return true;
    }
    return false;
  }

  bool only_jumps_lead_to(std::uint32_t label) const {
    const auto at = at_[label];
    return named_[label] == 1 && at != none && at > 0 && !falls_through(code_.lines[at - 1]);
  }

  /// The arm that only a test leads to.
  std::optional<Arm> taken_arm(std::uint32_t label) const {
    return only_jumps_lead_to(label) ? arm_at(at_[label] + 1) : std::nullopt;
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
                        is_pure(effects_of(code_, first)) && only_jumps_lead_to(first.label);
    const auto set = choice ? begin + 1 : begin;
    if (!sets(set))
      return std::nullopt;
    arm.variable = code_.lines[set].variable;
    arm.end = set + 1;
    arm.target = label_at(arm.end);
    if (arm.target == none)
      return std::nullopt;
    if (!choice)
      return arm;
    arm.alternative = at_[first.label];
    const auto other = arm.alternative + 1;
    const bool alike = sets(other) && code_.lines[other].variable == arm.variable &&
                       label_at(other + 1) == arm.target && arm.target != first.label;
    return alike ? std::optional(arm) : std::nullopt;
  }

  /// Whether an arm can run before test `i`, if these variables are needed on the other way.
  bool fits(std::uint32_t i, const Arm& arm, std::span<const std::uint64_t> needed) {
    bool read = false;
    each_line_read(code_, code_.lines[i],
                   [&](std::uint32_t v) { read = read || v == arm.variable; });
    return !contains(needed, arm.variable) && (!read || moved_test(i, arm));
  }

  /// `if s = 4` once `s = s + 1` has been computed before it: `if s = 5`.
  std::optional<Relation> moved_test(std::uint32_t i, const Arm& arm) {
    const auto& condition = code_.conditions[code_.lines[i].condition];
    auto relation = condition.first;
    const auto& line = code_.lines[arm.begin];
    const auto term = line.kind == LineKind::Let ? code_.terms[line.term] : Term{};
    const auto op = static_cast<spec::Operator>(term.what);
    const auto reads = [&](std::uint32_t one) {
      return code_.terms[one].kind == TermKind::Variable && code_.terms[one].left == arm.variable;
    };
    const bool equality =
        relation.comparison == Comparison::Equal || relation.comparison == Comparison::NotEqual;
    if (!equality || condition.glue != Glue::None || !reads(relation.left) ||
        !code_.is_number(relation.right) || term.kind != TermKind::Binary || !reads(term.left) ||
        !code_.is_number(term.right) ||
        (op != spec::Operator::Add && op != spec::Operator::Subtract))
      return std::nullopt;
    relation.right = code_.binary(op, relation.right, term.right);
    relation.left_range = relation.right_range = {};
    return relation;
  }

  /// Runs an arm before test `i`, which then leads to `label`; false, with all as it was, where
  /// that takes no line less.
  bool hoist(std::uint32_t i, const Arm& arm, std::uint32_t label) {
    const auto before = code_.lines;
    if (const auto moved = moved_test(i, arm)) {
      code_.conditions.push_back({});
      code_.conditions.back().first = *moved;
      code_.lines[i].condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    }
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
      take(arm.begin);
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

  // ---- results

  /// A routine in which several tests lead to where its result is set to a number begins with that
  /// number, and the tests only return.
  bool begin_with_result(std::uint32_t routine) {
    named_ = tidy(code_);
    at_ = lines_of_labels(code_);
    const auto flow = read_flow(code_);
    const auto entry = at_[code_.routines[routine]];
    const auto calls = std::count_if(code_.lines.begin(), code_.lines.end(), [&](const auto& line) {
      return line.kind == LineKind::Gosub && line.variable == routine;
    });
    if (entry == none || std::int64_t{named_[code_.routines[routine]]} != calls)
      return false;
    const auto live = read_liveness(code_, flow).in[flow.entries[routine]];
    for (auto i = entry; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      if (line.routine != routine || !returns_number(i) || !is_met(i) ||
          contains(live, line.variable) || !only_returned(flow, routine, line.variable))
        continue;
      auto first = line;
      first.origin = code_.lines[entry].origin;
      for (auto n = entry; n < code_.lines.size(); ++n)
        if (returns_number(n) && code_.lines[n].variable == first.variable &&
            same(code_, code_.lines[n].term, first.term) && code_.lines[n].routine == routine)
          code_.lines[n].kind = LineKind::Nothing;
      code_.lines.insert(code_.lines.begin() + entry + 1, first);
      clean_jumps(code_);
      return true;
    }
    return false;
  }

  bool returns_number(std::uint32_t i) const {
    return sets(i) && code_.is_number(code_.lines[i].term) &&
           code_.lines[i + 1].kind == LineKind::Return;
  }

  /// Whether several tests, and nothing else, lead to a line.
  bool is_met(std::uint32_t i) const {
    if (i < 2 || code_.lines[i - 1].kind != LineKind::Label)
      return false;
    const auto& above = code_.lines[i - 2];
    const auto tests = named_[code_.lines[i - 1].label] + (above.kind == LineKind::If ? 1 : 0);
    return tests > 1 && (above.kind == LineKind::If || !falls_through(above));
  }

  /// Whether a routine does nothing with a variable but set it right before it returns, twice at
  /// least.
  bool only_returned(const Flow& flow, std::uint32_t routine, std::uint32_t variable) const {
    std::size_t returned = 0;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      if (line.routine != routine)
        continue;
      bool touched = false;
      each_line_read(code_, line, [&](std::uint32_t v) { touched = touched || v == variable; });
      each_callee(code_, line, [&](std::uint32_t callee) {
        touched = touched || contains(flow.touched[callee], variable);
      });
      bool set = false;
      each_write(code_, line, [&](std::uint32_t v) { set = set || v == variable; });
      if (touched ||
          (set && (line.kind != LineKind::Let || code_.lines[i + 1].kind != LineKind::Return)))
        return false;
      returned += set ? 1 : 0;
    }
    return returned > 1;
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
