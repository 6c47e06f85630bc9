#include "structured/emit/choices.h"

#include "structured/analyse/flow.h"
#include "structured/analyse/sizes.h"
#include "structured/optimise/arms.h"
#include "structured/optimise/counted.h"
#include "structured/optimise/jumps.h"
#include "structured/text/structured_words.h"

#include <algorithm>

namespace orb::structured {
namespace {

bool is_missing(Comparison comparison) {
  return comparison == Comparison::LessEqual || comparison == Comparison::GreaterEqual;
}

/// True if the robot can express a relation: it has no `<=` and `>=`, but x <= 5 is x < 6 if that
/// does not wrap.
bool can_say(const Code& code, const Relation& relation) {
  return !is_missing(relation.comparison) || moved_side(code, relation) != Moved::Neither;
}

bool can_say(const Code& code, const Condition& condition) {
  return can_say(code, condition.first) &&
         (condition.glue == Glue::None || can_say(code, condition.second));
}

Condition opposite_of(Condition condition) {
  condition.first.comparison = opposite(condition.first.comparison);
  condition.second.comparison = opposite(condition.second.comparison);
  if (condition.glue != Glue::None)
    condition.glue = condition.glue == Glue::And ? Glue::Or : Glue::And;
  return condition;
}

bool in_documented_list(spec::Statement statement) {
  return spec::info(statement).in_then == spec::InThen::Listed;
}

/// Rewrites tests and the lines around them. Large because each kind of rewriting has its own
/// member.
class ChoiceWriter {
public:
  ChoiceWriter(Code& code, const Program& program, const Identity& identity)
      : code_(code), program_(program), identity_(identity) {}

  void run() {
    reads_ = reads_of(code_);
    while (join_tests())
      ;
    pair_arms();
    return_at_once();
    fold_branches();
    finish_tests();
    end_at_once();
    while (remove_unreached())
      ;
  }

private:
  bool is_label_there(std::uint32_t line, std::uint32_t label) const {
    for (; line < code_.lines.size() && (code_.lines[line].kind == LineKind::Label ||
                                         code_.lines[line].kind == LineKind::Nothing);
         ++line)
      if (code_.lines[line].kind == LineKind::Label && code_.lines[line].label == label)
        return true;
    return false;
  }

  std::uint8_t effects_of(const Condition& condition) const {
    return static_cast<std::uint8_t>(code_.terms[condition.first.left].effects |
                                     code_.terms[condition.first.right].effects);
  }

  /// True if the second test may be safe only because the first one narrows a variable that both
  /// read.
  bool leans_on(const Relation& first, const Relation& second) const {
    bool leans = false;
    for (const auto compared : {first.left, first.right})
      for (const auto term : {second.left, second.right})
        leans = leans || (code_.terms[compared].kind == TermKind::Variable &&
                          can_fault(code_, term, code_.terms[compared].left));
    return leans;
  }

  /// Joins two consecutive tests with `and` or `or`. The robot always computes both, so the second
  /// must have no effects.
  bool join_tests() {
    tidy(code_);
    bool changed = false;
    for (std::uint32_t i = 0; i + 1 < code_.lines.size(); ++i) {
      auto& line = code_.lines[i];
      auto& next = code_.lines[i + 1];
      if (line.kind != LineKind::If || next.kind != LineKind::If)
        continue;
      const auto& first = code_.conditions[line.condition];
      const auto& second = code_.conditions[next.condition];
      if (first.glue != Glue::None || second.glue != Glue::None ||
          (effects_of(second) & (effect::faults | effect::clears)) != 0 ||
          leans_on(first.first, second.first))
        continue;
      Condition joined;
      joined.second = second.first;
      if (line.label == next.label) {
        joined.first = first.first;
        joined.glue = Glue::Or;
      } else if (is_label_there(i + 2, line.label)) {
        joined.first = opposite_of(first).first;
        joined.glue = Glue::And;
      } else {
        continue;
      }
      // One of the two forms must be expressible later.
      if (!can_say(code_, joined) && !can_say(code_, opposite_of(joined)))
        continue;
      if ((effects_of(first) & effect::faults) != 0)
        next.origin = line.origin;
      next.condition = static_cast<std::uint32_t>(code_.conditions.size());
      code_.conditions.push_back(joined);
      line.kind = LineKind::Nothing;
      changed = true;
      ++i;
    }
    return changed;
  }

  /// Splits branches of two lines, or of two and one: repeating the test pairs each line of one
  /// branch with that of the other in one line of the robot.
  void pair_arms() {
    constexpr std::uint32_t most_bytes = 22; // of a test, as long as the jumps that it saves
    named_ = tidy(code_);
    for (auto i = static_cast<std::uint32_t>(code_.lines.size()); i-- > 0;) {
      const auto arms = arms_at(code_, named_, i);
      if (!arms || !arms->has_both() || arms->is_short() || arms->passed_end - arms->passed > 2 ||
          arms->taken_end - arms->taken > 2 || !can_test_again(i, *arms) ||
          bytes_of(code_, code_.lines[i]) > line_bytes + most_bytes)
        continue;
      const auto begin = code_.lines.begin();
      const std::vector<CodeLine> passed(begin + arms->passed, begin + arms->passed_end);
      const std::vector<CodeLine> taken(begin + arms->taken, begin + arms->taken_end);
      const auto test = code_.lines[i];
      std::vector<CodeLine> written;
      const auto label = [&](std::uint32_t name) {
        written.push_back(jump(test, name));
        written.back().kind = LineKind::Label;
      };
      for (const bool first : {true, false}) {
        const bool passes = !first || passed.size() == 2;
        const bool takes = !first || taken.size() == 2;
        const auto there = code_.labels++;
        const auto end = code_.labels++;
        written.push_back(copy_line(code_, test));
        written.back().label = takes && passes ? there : end;
        if (!passes) {
          auto& condition = code_.conditions[written.back().condition];
          condition = opposite_of(condition);
        }
        if (passes)
          written.push_back(first ? passed.front() : passed.back());
        if (passes && takes) {
          written.push_back(jump(test, end));
          label(there);
        }
        if (takes)
          written.push_back(first ? taken.front() : taken.back());
        label(end);
      }
      code_.lines.erase(begin + i, begin + arms->taken_end);
      code_.lines.insert(code_.lines.begin() + i, written.begin(), written.end());
    }
  }

  /// True if the test has the same result after the first lines of its branches, and can be
  /// expressed before each.
  bool can_test_again(std::uint32_t i, const Arms& arms) const {
    const auto& lines = code_.lines;
    const auto& condition = code_.conditions[lines[i].condition];
    bool good = condition.glue == Glue::None && can_say(code_, condition) &&
                can_say(code_, opposite_of(condition)) &&
                (effects_of(condition) & ~effect::elements) == 0;
    for (const auto& [first, last] :
         {std::pair{arms.passed, arms.passed_end - 1}, std::pair{arms.taken, arms.taken_end - 1}})
      good = good && (first == last || passes(lines[i], lines[first])) &&
             !may_fault(code_, lines[last]) && !may_fault(code_, lines[first]);
    return good;
  }

  /// True if the line can run before a test instead of after it. Variables that share a letter
  /// count as one.
  bool passes(const CodeLine& test, const CodeLine& line) const {
    const auto effects = structured::effects_of(code_, test);
    const auto still = line.kind == LineKind::Let          ? 0
                       : line.kind == LineKind::SetElement ? effect::elements
                                                           : effect::elements | effect::senses;
    bool good = !test.guard && structured::is_pure(effects) && (effects & still) == 0 &&
                line.kind != LineKind::Gosub;
    each_write(code_, line, [&](std::uint32_t set) {
      each_line_read(code_, test,
                     [&](std::uint32_t read) { good = good && identity_(read) != identity_(set); });
    });
    return good;
  }

  /// True if the line may be placed after `then` and `else`.
  static bool fits_branch(const CodeLine& line) {
    switch (line.kind) {
    case LineKind::Let:
    case LineKind::SetElement:
    case LineKind::SetSystem:
    case LineKind::Goto:
    case LineKind::Gosub:
    case LineKind::Return:
    case LineKind::On:
    case LineKind::Print: return true;
    case LineKind::Do: return in_documented_list(line.robot);
    case LineKind::Nothing:
    case LineKind::Label:
    case LineKind::If:
    case LineKind::For:
    case LineKind::Next:
    case LineKind::Switch:
    case LineKind::Choice: return false;
    }
    return false;
  }

  std::uint32_t add_branch(const CodeLine& line) {
    code_.branches.push_back(line);
    return static_cast<std::uint32_t>(code_.branches.size()) - 1;
  }
  CodeLine jump(const CodeLine& of, std::uint32_t label) const {
    CodeLine line;
    line.kind = LineKind::Goto;
    line.label = label;
    line.origin = of.origin;
    line.routine = of.routine;
    line.expansion = of.expansion;
    return line;
  }

  bool on_one_line(std::uint32_t a, std::uint32_t b) const {
    const auto [begin, end] =
        std::minmax(program_.statements[a].span.begin, program_.statements[b].span.begin);
    const std::string_view text = program_.text;
    return std::none_of(text.begin() + begin, text.begin() + end, is_line_end);
  }

  /// Assigns a robot line to one source line: the one whose part may stop the program. Returns
  /// false if there are several.
  bool name_origin(CodeLine& line, std::uint32_t taken, std::uint32_t passed) const {
    std::uint32_t origin = none;
    bool good = true;
    const auto add = [&](std::uint32_t statement) {
      good = good && (origin == none || on_one_line(origin, statement));
      origin = statement;
    };
    const auto& condition = code_.conditions[line.condition];
    auto effects = effects_of(condition);
    if (condition.glue != Glue::None)
      effects |= static_cast<std::uint8_t>(code_.terms[condition.second.left].effects |
                                           code_.terms[condition.second.right].effects);
    if ((effects & effect::faults) != 0)
      add(line.origin);
    for (const auto branch : {taken, passed})
      if (branch != none && may_fault(code_, code_.branches[branch]))
        add(code_.branches[branch].origin);
    if (good && origin != none)
      line.origin = origin;
    return good;
  }

  /// Expands `a <= b` of two unbounded values to `a < b or a = b`.
  void spell_out(Condition& condition) const {
    auto& first = condition.first;
    const auto& left = code_.terms[first.left];
    const auto& right = code_.terms[first.right];
    constexpr int longest = 6; // beyond, a jump to the next line is shorter
    if (condition.glue != Glue::None || can_say(code_, condition) ||
        ((left.effects | right.effects) & ~effect::elements) != 0 ||
        left.size + right.size > longest)
      return;
    condition.second = first;
    condition.second.comparison = Comparison::Equal;
    condition.glue = Glue::Or;
    first.comparison =
        first.comparison == Comparison::LessEqual ? Comparison::Less : Comparison::Greater;
  }

  /// Turns line `i` into an `if`: `taken` if its condition holds, `passed` if not.
  bool choose(std::uint32_t i, std::uint32_t taken, std::uint32_t passed) {
    auto& line = code_.lines[i];
    auto condition = code_.conditions[line.condition];
    if (passed == none)
      spell_out(condition);
    // Without an `else`, the condition must be the one that holds. With one, either works; prefer
    // the comparison that the robot has.
    const bool turned = is_missing(condition.first.comparison) && passed != none &&
                        can_say(code_, opposite_of(condition));
    if (taken == none || turned || !can_say(code_, condition)) {
      condition = opposite_of(condition);
      std::swap(taken, passed);
    }
    spell_out(condition);
    if (taken == none || !can_say(code_, condition) || !name_origin(line, taken, passed))
      return false;
    code_.conditions.push_back(condition);
    line.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    line.kind = LineKind::Choice;
    line.term = taken;
    line.end = passed;
    return true;
  }

  /// Replaces a jump from a test to a `return` by the `return` itself.
  void return_at_once() {
    const auto at = lines_of_labels(code_);
    std::vector<CodeLine> lines;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      lines.push_back(code_.lines[i]);
      auto& test = lines.back();
      auto target = test.kind == LineKind::If ? at[test.label] : none;
      while (target < code_.lines.size() && code_.lines[target].kind == LineKind::Label)
        ++target;
      if (target >= code_.lines.size() || code_.lines[target].kind != LineKind::Return ||
          code_.lines[i + 1].kind == LineKind::Goto || is_label_there(i + 1, test.label) ||
          is_label_there(i + 2, test.label))
        continue;
      code_.conditions.push_back(opposite_of(code_.conditions[test.condition]));
      auto leave = code_.lines[target];
      leave.origin = test.origin;
      test.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
      test.label = code_.labels++;
      auto label = leave;
      label.kind = LineKind::Label;
      label.label = test.label;
      lines.push_back(leave);
      lines.push_back(label);
    }
    code_.lines = std::move(lines);
    while (remove_unreached())
      ;
  }

  void fold_branches() {
    named_ = tidy(code_);
    at_ = lines_of_labels(code_);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (code_.lines[i].kind == LineKind::If)
        fold(i);
    tidy(code_);
  }

  void fold(std::uint32_t i) {
    const auto size = code_.lines.size();
    auto& line = code_.lines[i];
    if (i + 1 >= size || !fits_branch(code_.lines[i + 1]))
      return;
    auto& first = code_.lines[i + 1];
    // if c goto L1; s1; goto L2; L1: s2; L2:
    if (i + 4 < size && code_.lines[i + 2].kind == LineKind::Goto && falls(first) &&
        code_.lines[i + 3].kind == LineKind::Label && code_.lines[i + 3].label == line.label &&
        named_[line.label] == 1 && fits_branch(code_.lines[i + 4]) &&
        is_label_there(i + 5, code_.lines[i + 2].label)) {
      if (choose(i, add_branch(code_.lines[i + 4]), add_branch(first))) {
        first.kind = code_.lines[i + 2].kind = LineKind::Nothing;
        code_.lines[i + 3].kind = code_.lines[i + 4].kind = LineKind::Nothing;
      }
      return;
    }
    // if c goto L1; s1; [goto] L2 … and elsewhere L1: s2; goto L2
    const auto there = at_[line.label];
    if (falls(first) && there != none && there > 0 && there + 2 < size && named_[line.label] == 1 &&
        !falls(code_.lines[there - 1]) && falls(code_.lines[there + 1]) &&
        fits_branch(code_.lines[there + 1]) && code_.lines[there + 2].kind == LineKind::Goto) {
      const auto& jump = code_.lines[there + 2];
      const bool meets =
          is_label_there(i + 2, jump.label) ||
          (code_.lines[i + 2].kind == LineKind::Goto && code_.lines[i + 2].label == jump.label);
      if (meets && choose(i, add_branch(code_.lines[there + 1]), add_branch(first))) {
        first.kind = LineKind::Nothing;
        for (const auto gone : {there, there + 1, there + 2})
          code_.lines[gone].kind = LineKind::Nothing;
        return;
      }
    }
    // if c goto L; s; L: or goto L
    if (i + 2 < size && falls(first) && code_.lines[i + 2].kind == LineKind::Goto &&
        code_.lines[i + 2].label == line.label && choose(i, none, add_branch(first))) {
      first.kind = LineKind::Nothing;
      sense_in(i);
      return;
    }
    if (is_label_there(i + 2, line.label)) {
      const auto target = line.label;
      if (choose(i, none, add_branch(first))) {
        first.kind = LineKind::Nothing;
        sense_in(i);
      } else if (choose(i, add_branch(jump(line, target)), add_branch(first))) {
        first.kind = LineKind::Nothing;
      }
      return;
    }
    // if c goto L1; goto L2
    if (first.kind == LineKind::Goto || first.kind == LineKind::Return) {
      if (choose(i, add_branch(jump(line, line.label)), add_branch(first)))
        first.kind = LineKind::Nothing;
    }
  }

  /// Moves `B = abs roll` above `if A < B then A = B` into the test: within one line, both reads of
  /// a sensor give the same value.
  void sense_in(std::uint32_t i) {
    // A sensor or a function of it: the test becomes no longer than the line it replaces.
    constexpr std::uint16_t largest = 2;
    if (i == 0 || code_.lines[i - 1].kind != LineKind::Let)
      return;
    auto& set = code_.lines[i - 1];
    const auto& term = code_.terms[set.term];
    const auto is_it = [&](std::uint32_t root) {
      return code_.terms[root].kind == TermKind::Variable && code_.terms[root].left == set.variable;
    };
    auto& condition = code_.conditions[code_.lines[i].condition];
    auto& branch = code_.branches[code_.lines[i].term];
    auto& tested = is_it(condition.first.left) ? condition.first.left : condition.first.right;
    if (term.effects != effect::senses || term.size > largest || reads_[set.variable] != 2 ||
        code_.variables[set.variable].kept || condition.glue != Glue::None || !is_it(tested) ||
        branch.kind != LineKind::Let || !is_it(branch.term))
      return;
    tested = branch.term = set.term;
    set.kind = LineKind::Nothing;
  }

  static bool falls(const CodeLine& line) { return falls_through(line); }

  /// Writes the remaining tests as `then goto`, with a jump to the next line if needed.
  void finish_tests() {
    std::vector<CodeLine> lines;
    lines.swap(code_.lines);
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
      code_.lines.push_back(lines[i]);
      if (lines[i].kind != LineKind::If)
        continue;
      const auto last = static_cast<std::uint32_t>(code_.lines.size()) - 1;
      const auto target = add_branch(jump(lines[i], lines[i].label));
      if (choose(last, target, none))
        continue;
      const auto next = code_.labels++;
      choose(last, target, add_branch(jump(lines[i], next)));
      CodeLine label;
      label.kind = LineKind::Label;
      label.label = next;
      label.origin = lines[i].origin;
      code_.lines.push_back(label);
    }
  }

  std::uint32_t past_labels(std::uint32_t i) const {
    while (i < code_.lines.size() && code_.lines[i].kind == LineKind::Label)
      ++i;
    return i;
  }

  /// Replaces a jump to a `return`, an `end` or another jump by its target.
  void end_at_once() {
    tidy(code_);
    const auto at = lines_of_labels(code_);
    enum class Where : std::uint8_t { Alone, InBranch };
    const auto lead_on = [&](CodeLine& line, Where where) {
      if (line.kind != LineKind::Goto || at[line.label] == none)
        return;
      const auto target = past_labels(at[line.label]);
      if (target == code_.lines.size())
        return;
      const auto& last = code_.lines[target];
      if (last.kind != LineKind::Return && last.kind != LineKind::Goto &&
          (!ends_program(last) || (where == Where::InBranch && !fits_branch(last))))
        return;
      const auto origin = line.origin;
      line = last;
      line.origin = origin;
    };
    for (auto& line : code_.lines) {
      lead_on(line, Where::Alone);
      if (line.kind == LineKind::Choice)
        for (const auto branch : {line.term, line.end})
          if (branch != none)
            lead_on(code_.branches[branch], Where::InBranch);
    }
  }

  /// Removes lines that became unreachable when jumps to them were replaced, and jumps over such
  /// lines.
  bool remove_unreached() {
    tidy(code_);
    bool removed = false;
    bool reached = true;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      auto& line = code_.lines[i];
      reached = reached || line.kind == LineKind::Label;
      if (!reached || (line.kind == LineKind::Goto && is_label_there(i + 1, line.label))) {
        line.kind = LineKind::Nothing;
        removed = true;
      } else if (line.kind != LineKind::Nothing) {
        reached = falls(line);
      }
    }
    return removed;
  }

  Code& code_;
  const Program& program_;
  const Identity& identity_;
  std::vector<std::uint32_t> at_;    ///< of each label: its line, while branches are folded
  std::vector<std::uint32_t> named_; ///< of each label: its references, while branches are folded
  std::vector<std::uint32_t> reads_; ///< of each variable: its reads
};

} // namespace

void write_choices(Code& code, const LetterAllocation& letters, const Program& program) {
  for (auto& line : code.lines)
    if (line.kind == LineKind::Let && code.terms[line.term].kind == TermKind::Variable &&
        letters.of[code.terms[line.term].left] == letters.of[line.variable])
      line.kind = LineKind::Nothing;
  clean_jumps(code);
  const Identity letter = [&](std::uint32_t variable) {
    return std::uint32_t{letters.of[variable]};
  };
  count_loops(code, letter);
  clean_jumps(code);
  ChoiceWriter(code, program, letter).run();
}

} // namespace orb::structured
