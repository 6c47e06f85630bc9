#include "structured/optimise/known_values.h"

#include "spec/limits.h"
#include "structured/analyse/ranges.h"
#include "structured/optimise/split.h"
#include "structured/optimise/thread.h"

#include <algorithm>
#include <map>
#include <optional>

namespace orb::structured {
namespace {

using compiler::Range;
using spec::Operator;

/// Rewrites a program with the known ranges of its values.
class Rewriter {
public:
  explicit Rewriter(Code& code) : code_(code), ranges_(code) {}

  bool run(BranchChanges ways) {
    if (!ranges_.follow())
      return false;
    count_reads();
    rewrite();
    if (ways != BranchChanges::AsTheyAre)
      changed_ = thread_tests(code_, ranges_, added_) || changed_;
    if (!changed_ && added_.empty() && ways == BranchChanges::Split)
      return split_ways(code_, ranges_);
    add_lines();
    return changed_;
  }

private:
  struct Reads {
    std::uint32_t all = 0;
    std::uint32_t constant = 0;
    std::uint32_t digits = 0; ///< of the numbers that would replace it
    std::uint32_t sets = 0;
  };

  void count_reads() {
    reads_.assign(code_.variables.size(), {});
    ranges_.each_state([&](std::uint32_t i, const VariableRanges& state) {
      const auto& line = code_.lines[i];
      each_line_read(code_, line, [&](std::uint32_t v) {
        ++reads_[v].all;
        if (!state[v].constant() || v == index_variable)
          return;
        ++reads_[v].constant;
        reads_[v].digits += compiler::printed(state[v]).most + (state[v].lo < 0 ? 2 : 0);
      });
      // An operand of the line itself must stay a variable.
      if (line.kind == LineKind::Next || line.kind == LineKind::Switch)
        reads_[line.variable].constant = 0;
      each_write(code_, line, [&](std::uint32_t v) { ++reads_[v].sets; });
    });
    for (const auto& line : code_.lines)
      if (line.kind == LineKind::Next || line.kind == LineKind::Switch ||
          line.kind == LineKind::For)
        reads_[line.variable].all += 1;
  }

  /// True if a variable is replaced by numbers everywhere, which makes its assignments dead.
  bool vanishes(std::uint32_t v) const {
    constexpr std::uint32_t assignment = 7; // `12 A=0` and its line ending
    const auto& reads = reads_[v];
    return reads.all > 0 && reads.all == reads.constant &&
           reads.digits <= reads.all + assignment * reads.sets;
  }

  /// Selects the known numbers that replace their variables. Negative ones are printed in
  /// parentheses, and so may be deeper than a variable; so may a folded term. Without both, a term
  /// is as deep as before, so a variable can always be eliminated.
  enum class Known : std::uint8_t { All, Positive, PositiveUnfolded };

  /// A term with known variables replaced by numbers.
  std::uint32_t replaced(std::uint32_t term, const VariableRanges& state) {
    for (const auto known : {Known::All, Known::Positive, Known::PositiveUnfolded})
      if (const auto result = replaced(term, state, known); !is_too_deep(result))
        return result;
    return term;
  }

  std::uint32_t replaced(std::uint32_t term, const VariableRanges& state, Known known) {
    const auto node = code_.terms[term];
    switch (node.kind) {
    case TermKind::Number:
    case TermKind::System: return term;
    case TermKind::Variable:
      if (node.left != index_variable && state[node.left].constant() &&
          (known == Known::All || state[node.left].lo >= 0) &&
          (vanishes(node.left) || (state[node.left].lo >= 0 && state[node.left].lo < 10)))
        return code_.number(state[node.left].lo);
      return term;
    case TermKind::Element: {
      if (is_element(state[index_variable]))
        code_.terms[term].effects = effect::elements;
      return term;
    }
    case TermKind::Binary: {
      const auto op = static_cast<Operator>(node.what);
      const auto left = replaced(node.left, state, known);
      const auto right = replaced(node.right, state, known);
      auto result = term;
      if (left != node.left || right != node.right) {
        if (known != Known::PositiveUnfolded)
          result = code_.binary(op, left, right);
        if (known == Known::PositiveUnfolded || is_too_deep(result))
          result = unfolded(node, left, right);
      }
      improve(result, state);
      return result;
    }
    case TermKind::Call: {
      const auto operand = replaced(node.left, state, known);
      auto result = term;
      if (operand != node.left)
        result = code_.call(static_cast<spec::Function>(node.what), operand);
      improve(result, state);
      return result;
    }
    }
    return term;
  }

  static bool is_element(Range index) {
    return index.lo >= 1 && index.hi <= spec::value_of(spec::Limit::IndexedVariables);
  }

  bool is_too_deep(std::uint32_t term) const {
    return code_.terms[term].levels > spec::value_of(spec::Limit::ExpressionLevels);
  }

  /// The same term with other operands, unfolded: folding may make it deeper.
  std::uint32_t unfolded(Term node, std::uint32_t left, std::uint32_t right) {
    node.left = left;
    node.right = right;
    node.levels = levels_of(code_, static_cast<Operator>(node.what), left, right);
    return code_.add(node);
  }

  /// Clears fault flags for faults that cannot happen.
  void improve(std::uint32_t term, const VariableRanges& state) {
    auto& node = code_.terms[term];
    if (node.kind == TermKind::Binary) {
      const auto op = static_cast<Operator>(node.what);
      const auto right = ranges_.range_of(node.right, state);
      const bool divides = op == Operator::Divide || op == Operator::Remainder;
      const bool shifts = op == Operator::ShiftLeft || op == Operator::ShiftRight;
      const bool faults =
          (divides && right.has(0)) ||
          (shifts && (right.lo < 0 || right.hi > spec::value_of(spec::Limit::GreatestShift)));
      node.effects = static_cast<std::uint8_t>(code_.terms[node.left].effects |
                                               code_.terms[node.right].effects |
                                               (faults ? effect::faults : 0));
    } else if (node.kind == TermKind::Call) {
      const auto function = static_cast<spec::Function>(node.what);
      const auto operand = ranges_.range_of(node.left, state);
      const bool faults = operand.lo < spec::info(function).least;
      node.effects =
          static_cast<std::uint8_t>(code_.terms[node.left].effects | (faults ? effect::faults : 0) |
                                    (function == spec::Function::Rnd ? effect::clears : 0));
    }
  }

  void rewrite() {
    std::vector<bool> reached(code_.lines.size(), false);
    ranges_.each_state([&](std::uint32_t i, VariableRanges& state) {
      reached[i] = true;
      auto& line = code_.lines[i];
      if (sets_what_is_there(line, state)) {
        line.kind = LineKind::Nothing;
        changed_ = true;
        return;
      }
      if (line.kind == LineKind::If)
        learn(line, state);
      each_root(code_, line, [&](std::uint32_t& root) {
        // The end of a loop is computed after its variable is set.
        if (line.kind == LineKind::For && &root == &line.end)
          state[line.variable] = ranges_.range_of(line.term, state);
        const auto better = replaced(root, state);
        changed_ = changed_ || better != root;
        root = better;
      });
      if (line.kind == LineKind::If)
        decide(line, state);
      line.proven = is_element(state[index_variable]);
      if (line.kind == LineKind::Print || line.kind == LineKind::Do)
        for (auto n = line.parts_begin; n < line.parts_end; ++n)
          if (code_.parts[n].kind == PartKind::Term)
            code_.parts[n].range = ranges_.range_of(code_.parts[n].value, state);
      if (line.kind == LineKind::Switch)
        choose(i, state[line.variable]);
    });
    code_.wrong_indices.clear();
    for (const auto& [statement, index] : wrong_indices_)
      if (index)
        code_.wrong_indices.push_back({statement, *index});
    cut_unreached(reached);
  }

  /// True if a variable is assigned its current value. The previous value is known only for
  /// variables that are assigned a number.
  bool sets_what_is_there(const CodeLine& line, const VariableRanges& state) const {
    return line.kind == LineKind::Let && line.variable != index_variable &&
           code_.is_number(line.term) && state[line.variable].constant() &&
           code_.terms[line.term].value == state[line.variable].lo;
  }

  /// Removes unreachable code, such as code after a sub that always ends the program.
  void cut_unreached(const std::vector<bool>& reached) {
    for (const auto& block : ranges_.flow().blocks) {
      bool cut = false;
      for (auto i = block.begin; i < block.end; ++i) {
        auto& line = code_.lines[i];
        if (reached[i] || line.kind == LineKind::Label || line.kind == LineKind::Nothing)
          continue;
        changed_ = changed_ || !cut;
        line.kind = cut ? LineKind::Nothing : LineKind::Do;
        line.robot = spec::Statement::End;
        line.parts_begin = line.parts_end = 0;
        cut = true;
      }
    }
  }

  void learn(CodeLine& line, const VariableRanges& state) {
    auto& condition = code_.conditions[line.condition];
    condition.first.left_range = ranges_.range_of(condition.first.left, state);
    condition.first.right_range = ranges_.range_of(condition.first.right, state);
    if (condition.glue == Glue::None)
      return;
    condition.second.left_range = ranges_.range_of(condition.second.left, state);
    condition.second.right_range = ranges_.range_of(condition.second.right, state);
  }

  void decide(CodeLine& line, const VariableRanges& state) {
    auto& condition = code_.conditions[line.condition];
    if (condition.glue != Glue::None)
      return;
    auto& relation = condition.first;
    const auto answer = answer_of(ranges_, relation, state);
    // Keep the test of an index that is certainly wrong, so that the robot reports it.
    const bool to_good = relation.comparison == Comparison::LessEqual ||
                         relation.comparison == Comparison::GreaterEqual;
    if (line.guard && (to_good || answer == true))
      judge_index(line.origin, (answer == false) == to_good, state[index_variable]);
    const bool always = answer == true && (!line.guard || to_good);
    const bool never = answer == false && (!line.guard || !to_good);
    const auto effects = code_.terms[relation.left].effects | code_.terms[relation.right].effects;
    if ((always || never) && (effects & (effect::faults | effect::clears)) != 0)
      keep_computing(line, always);
    else if (always)
      line.kind = LineKind::Goto;
    else if (never)
      line.kind = LineKind::Nothing;
    changed_ = changed_ || line.kind != LineKind::If;
  }

  /// Records one test of a statement's index. The statement may occur several times, with several
  /// indices.
  void judge_index(std::uint32_t statement, bool wrong, Range index) {
    const auto [at, fresh] = wrong_indices_.try_emplace(statement, std::nullopt);
    if (!wrong)
      at->second = std::nullopt;
    else if (fresh)
      at->second = index;
    else if (at->second)
      at->second = compiler::join(*at->second, index);
  }

  /// Keeps a test with a known outcome for its side effects: it jumps to the next line, where the
  /// path continues.
  void keep_computing(CodeLine& line, bool always) {
    auto after = line;
    after.kind = LineKind::Label;
    after.label = code_.labels++;
    const auto place = static_cast<std::uint32_t>(&line - code_.lines.data()) + 1;
    added_.push_back({place, after});
    if (always) {
      auto jump = line;
      jump.kind = LineKind::Goto;
      added_.push_back({place, jump});
    }
    line.label = after.label;
  }

  void add_lines() {
    if (added_.empty())
      return;
    std::stable_sort(added_.begin(), added_.end(),
                     [](const AddedLine& a, const AddedLine& b) { return a.first < b.first; });
    std::vector<CodeLine> lines;
    lines.reserve(code_.lines.size() + added_.size());
    auto next = added_.begin();
    for (std::uint32_t i = 0; i <= code_.lines.size(); ++i) {
      for (; next != added_.end() && next->first == i; ++next)
        lines.push_back(next->second);
      if (i < code_.lines.size())
        lines.push_back(code_.lines[i]);
    }
    code_.lines = std::move(lines);
  }

  /// Turns a choice among consecutive numbers, if no others are possible, into the robot's `on`.
  void choose(std::uint32_t i, Range chosen) {
    constexpr std::int64_t most_targets = 12;
    constexpr std::size_t least_cases = 3;
    auto& line = code_.lines[i];
    const auto span = std::int64_t{chosen.hi} - chosen.lo + 1;
    if (span == 1) {
      for (auto n = line.parts_begin; n < line.parts_end; ++n)
        if (code_.cases[n].lo <= chosen.lo && chosen.lo <= code_.cases[n].hi)
          line.label = code_.cases[n].label;
      line.kind = LineKind::Goto;
      line.parts_begin = line.parts_end = 0; // they held cases
      return;
    }
    if (span > most_targets || line.parts_end - line.parts_begin < least_cases)
      return;
    const auto begin = static_cast<std::uint32_t>(code_.parts.size());
    for (std::int64_t value = chosen.lo; value <= chosen.hi; ++value) {
      auto label = line.label;
      for (auto n = line.parts_begin; n < line.parts_end; ++n)
        if (code_.cases[n].lo <= value && value <= code_.cases[n].hi)
          label = code_.cases[n].label;
      code_.parts.push_back({PartKind::Label, label, {}, {}});
    }
    line.kind = LineKind::On;
    line.term = code_.binary(Operator::Add, code_.read(line.variable), code_.number(1 - chosen.lo));
    line.parts_begin = begin;
    line.parts_end = static_cast<std::uint32_t>(code_.parts.size());
  }

  Code& code_;
  Ranges ranges_;
  std::vector<Reads> reads_;
  std::map<std::uint32_t, std::optional<Range>> wrong_indices_; ///< by statement; none: may be
                                                                ///< valid
  std::vector<AddedLine> added_;
  bool changed_ = false;
};

} // namespace

bool use_values(Code& code, BranchChanges ways) {
  return Rewriter(code).run(ways);
}

} // namespace orb::structured
