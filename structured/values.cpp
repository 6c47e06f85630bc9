#include "structured/values.h"

#include "compiler/range.h"
#include "spec/limits.h"
#include "structured/flow.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace orb::structured {
namespace {

using compiler::Range;
using spec::Operator;

constexpr std::int32_t least_value = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t greatest_value = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t most_cells = std::size_t{1} << 21; ///< blocks times variables

/// What the values of a comparison's left side can be where it holds; nothing: it cannot hold.
std::optional<Range> where(Comparison comparison, Range left, Range right) {
  std::int64_t lo = left.lo;
  std::int64_t hi = left.hi;
  switch (comparison) {
  case Comparison::Equal:
    lo = std::max<std::int64_t>(lo, right.lo);
    hi = std::min<std::int64_t>(hi, right.hi);
    break;
  case Comparison::NotEqual:
    if (right.constant() && lo == right.lo)
      ++lo;
    if (right.constant() && hi == right.lo)
      --hi;
    break;
  case Comparison::Less: hi = std::min(hi, std::int64_t{right.hi} - 1); break;
  case Comparison::LessEqual: hi = std::min<std::int64_t>(hi, right.hi); break;
  case Comparison::Greater: lo = std::max(lo, std::int64_t{right.lo} + 1); break;
  case Comparison::GreaterEqual: lo = std::max<std::int64_t>(lo, right.lo); break;
  }
  if (lo > hi)
    return std::nullopt;
  return Range{static_cast<std::int32_t>(lo), static_cast<std::int32_t>(hi)};
}

enum class Outcome : std::uint8_t { Unknown, Always, Never };

Outcome outcome_of(Comparison comparison, Range left, Range right) {
  if (!where(comparison, left, right))
    return Outcome::Never;
  if (!where(opposite(comparison), left, right))
    return Outcome::Always;
  return Outcome::Unknown;
}

using State = std::vector<Range>;

class Values {
public:
  explicit Values(Code& code) : code_(code), flow_(read_flow(code)) {}

  void run() {
    if (flow_.blocks.size() * code_.variables.size() > most_cells)
      return;
    find_landmarks();
    find_data();
    follow();
    count_reads();
    rewrite();
  }

private:
  // ---- the values of terms

  Range range_of(std::uint32_t term, const State& state) const {
    const auto& node = code_.terms[term];
    switch (node.kind) {
    case TermKind::Number: return Range::only(node.value);
    case TermKind::Variable: return state[node.left];
    case TermKind::Element: return {};
    case TermKind::System: {
      const auto& row = spec::variables[node.what];
      return {row.least, row.greatest};
    }
    case TermKind::Binary:
      return compiler::apply(static_cast<Operator>(node.what), range_of(node.left, state),
                             range_of(node.right, state));
    case TermKind::Call:
      return compiler::apply(static_cast<spec::Function>(node.what), range_of(node.left, state));
    }
    return {};
  }

  /// Numbers at which growing ranges stop first: those that the program names, and their
  /// neighbours.
  void find_landmarks() {
    for (const auto& term : code_.terms)
      if (term.kind == TermKind::Number)
        for (const std::int64_t n : {-1, 0, 1})
          if (term.value + n >= least_value && term.value + n <= greatest_value)
            landmarks_.push_back(static_cast<std::int32_t>(term.value + n));
    landmarks_.push_back(least_value);
    landmarks_.push_back(greatest_value);
    std::sort(landmarks_.begin(), landmarks_.end());
    landmarks_.erase(std::unique(landmarks_.begin(), landmarks_.end()), landmarks_.end());
  }

  Range widen(Range before, Range now) const {
    if (now.lo < before.lo)
      now.lo = *std::prev(std::upper_bound(landmarks_.begin(), landmarks_.end(), now.lo));
    if (now.hi > before.hi)
      now.hi = *std::lower_bound(landmarks_.begin(), landmarks_.end(), now.hi);
    return now;
  }

  void find_data() {
    bool any = false;
    for (const auto& line : code_.lines) {
      if (line.kind != LineKind::Do || line.robot != spec::Statement::Data)
        continue;
      for (auto i = line.parts_begin; i < line.parts_end; ++i) {
        const auto value = range_of(code_.parts[i].value, {});
        data_ = any ? compiler::join(data_, value) : value;
        any = true;
      }
    }
  }

  // ---- the state along the ways of the program

  void follow() {
    const auto variables = code_.variables.size();
    states_.assign(flow_.blocks.size(), {});
    visits_.assign(flow_.blocks.size(), 0);
    ends_.assign(code_.labels, Range{greatest_value, least_value});
    returns_.assign(code_.routines.size(), {});
    waiting_.assign(flow_.blocks.size(), false);
    if (flow_.blocks.empty())
      return;
    enter(0, State(variables, Range::only(0)));
    while (!work_.empty()) {
      const auto least = std::min_element(work_.begin(), work_.end());
      const auto b = *least;
      *least = work_.back();
      work_.pop_back();
      waiting_[b] = false;
      visit(b);
    }
  }

  void enter(std::uint32_t b, const State& state) {
    if (b == none)
      return;
    auto& known = states_[b];
    if (known.empty()) {
      known = state;
    } else {
      constexpr std::uint32_t patience = 2;
      constexpr std::uint32_t limit = 24;
      bool changed = false;
      for (std::size_t v = 0; v < known.size(); ++v) {
        auto joined = compiler::join(known[v], state[v]);
        if (joined == known[v])
          continue;
        if (visits_[b] > limit)
          joined = {};
        else if (visits_[b] > patience)
          joined = widen(known[v], joined);
        known[v] = joined;
        changed = true;
      }
      if (!changed)
        return;
    }
    if (!waiting_[b]) {
      waiting_[b] = true;
      work_.push_back(b);
    }
  }

  void visit(std::uint32_t b) {
    ++visits_[b];
    const auto& block = flow_.blocks[b];
    auto state = states_[b];
    for (auto i = block.begin; i < block.end; ++i) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Gosub || line.kind == LineKind::OnGosub) {
        if (!follow_calls(line, state, b))
          return;
      } else {
        apply(line, state);
      }
    }
    leave(b, code_.lines[block.end - 1], state);
  }

  void apply(const CodeLine& line, State& state) {
    if (line.kind == LineKind::Let) {
      state[line.variable] = range_of(line.term, state);
    } else if (line.kind == LineKind::For) {
      state[line.variable] = range_of(line.term, state);
      ends_[line.label] = compiler::join(ends_[line.label], range_of(line.end, state));
    } else if (line.kind == LineKind::Do) {
      for (auto i = line.parts_begin; i < line.parts_end; ++i)
        if (code_.parts[i].kind == PartKind::Variable)
          state[code_.parts[i].value] = line.robot == spec::Statement::Read ? data_ : Range{};
    }
  }

  /// The state behind a call; false where nothing is known to come back yet.
  bool follow_calls(const CodeLine& line, State& state, std::uint32_t from) {
    State joined;
    const auto one = [&](std::uint32_t routine) {
      enter(flow_.entries[routine], state);
      auto& returned = returns_[routine];
      if (std::find(returned.callers.begin(), returned.callers.end(), from) ==
          returned.callers.end())
        returned.callers.push_back(from);
      if (returned.state.empty())
        return;
      auto after = state;
      for (std::uint32_t v = 0; v < after.size(); ++v)
        if (contains(flow_.written[routine], v))
          after[v] = returned.state[v];
      if (joined.empty()) {
        joined = std::move(after);
        return;
      }
      for (std::size_t v = 0; v < after.size(); ++v)
        joined[v] = compiler::join(joined[v], after[v]);
    };
    if (line.kind == LineKind::Gosub)
      one(line.variable);
    else
      for (auto i = line.parts_begin; i < line.parts_end; ++i)
        one(code_.parts[i].text.begin);
    if (joined.empty())
      return false;
    state = std::move(joined);
    return true;
  }

  void leave(std::uint32_t b, const CodeLine& line, State& state) {
    const auto& block = flow_.blocks[b];
    if (line.kind == LineKind::If)
      return leave_if(b, line, state);
    if (line.kind == LineKind::Next)
      return leave_next(b, line, state);
    if (line.kind == LineKind::Switch)
      return leave_switch(line, state);
    if (line.kind == LineKind::Return)
      return leave_routine(line.routine, state);
    for (const auto next : flow_.successors_of(block))
      enter(next, state);
  }

  void leave_routine(std::uint32_t routine, const State& state) {
    auto& returned = returns_[routine];
    bool changed = returned.state.empty();
    if (changed)
      returned.state = state;
    for (std::size_t v = 0; v < state.size(); ++v) {
      const auto joined = compiler::join(returned.state[v], state[v]);
      changed = changed || !(joined == returned.state[v]);
      returned.state[v] = joined;
    }
    if (!changed)
      return;
    for (const auto caller : returned.callers)
      if (!waiting_[caller]) {
        waiting_[caller] = true;
        work_.push_back(caller);
      }
  }

  /// Narrows what is known to where a relation holds; false where it cannot.
  bool assume(const Relation& relation, Comparison comparison, State& state) const {
    const auto left = range_of(relation.left, state);
    const auto right = range_of(relation.right, state);
    const auto narrowed = where(comparison, left, right);
    const auto mirror = where(mirrored(comparison), right, left);
    if (!narrowed || !mirror)
      return false;
    if (code_.terms[relation.left].kind == TermKind::Variable)
      state[code_.terms[relation.left].left] = *narrowed;
    if (code_.terms[relation.right].kind == TermKind::Variable)
      state[code_.terms[relation.right].left] = *mirror;
    return true;
  }

  void leave_if(std::uint32_t b, const CodeLine& line, const State& state) {
    const auto& condition = code_.conditions[line.condition];
    const auto target = flow_.block_of_label[line.label];
    const bool single = condition.glue == Glue::None;
    auto taken = state;
    if (!single || assume(condition.first, condition.first.comparison, taken))
      enter(target, taken);
    auto passed = state;
    if ((!single || assume(condition.first, opposite(condition.first.comparison), passed)) &&
        b + 1 < flow_.blocks.size())
      enter(b + 1, passed);
  }

  void leave_next(std::uint32_t b, const CodeLine& line, State& state) {
    const auto stepped =
        compiler::apply(Operator::Add, state[line.variable], Range::only(line.step));
    const auto end = ends_[line.label];
    const bool up = line.step > 0;
    if (const auto within =
            where(up ? Comparison::LessEqual : Comparison::GreaterEqual, stepped, end)) {
      state[line.variable] = *within;
      enter(flow_.block_of_label[line.label], state);
    }
    const auto nearest = up ? Range::only(end.lo) : Range::only(end.hi);
    if (const auto past = where(up ? Comparison::Greater : Comparison::Less, stepped, nearest)) {
      state[line.variable] = *past;
      if (b + 1 < flow_.blocks.size())
        enter(b + 1, state);
    }
  }

  void leave_switch(const CodeLine& line, const State& state) {
    const auto chosen = state[line.variable];
    auto others = std::int64_t{chosen.hi} - chosen.lo + 1; // values without a case
    for (auto i = line.parts_begin; i < line.parts_end; ++i) {
      const auto& one = code_.cases[i];
      if (chosen.misses(one.lo, one.hi))
        continue;
      auto narrowed = state;
      const Range common{std::max(chosen.lo, one.lo), std::min(chosen.hi, one.hi)};
      others -= std::int64_t{common.hi} - common.lo + 1;
      narrowed[line.variable] = common;
      enter(flow_.block_of_label[one.label], narrowed);
    }
    if (others > 0)
      enter(flow_.block_of_label[line.label], state);
  }

  // ---- rewriting

  struct Reads {
    std::uint32_t all = 0;
    std::uint32_t constant = 0;
    std::uint32_t digits = 0; ///< of the numbers that would stand in its place
    std::uint32_t sets = 0;
  };

  template <typename Visit>
  void each_state(Visit visit) {
    for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
      if (states_[b].empty())
        continue;
      auto state = states_[b];
      for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i) {
        visit(i, state);
        const auto line = code_.lines[i];
        if (line.kind == LineKind::Gosub || line.kind == LineKind::OnGosub) {
          if (!follow_calls(line, state, b))
            break;
        } else {
          apply(line, state);
        }
      }
    }
    work_.clear();
  }

  void count_reads() {
    reads_.assign(code_.variables.size(), {});
    each_state([&](std::uint32_t i, const State& state) {
      const auto& line = code_.lines[i];
      each_line_read(code_, line, [&](std::uint32_t v) {
        ++reads_[v].all;
        if (!state[v].constant() || v == index_variable)
          return;
        ++reads_[v].constant;
        reads_[v].digits += compiler::printed(state[v]).most + (state[v].lo < 0 ? 2 : 0);
      });
      // What is read by a line itself stays a variable.
      if (line.kind == LineKind::Next || line.kind == LineKind::Switch)
        reads_[line.variable].constant = 0;
      each_write(code_, line, [&](std::uint32_t v) { ++reads_[v].sets; });
    });
    for (const auto& line : code_.lines)
      if (line.kind == LineKind::Next || line.kind == LineKind::Switch ||
          line.kind == LineKind::For)
        reads_[line.variable].all += 1;
  }

  /// Whether a variable becomes numbers everywhere: its assignments then go.
  bool vanishes(std::uint32_t v) const {
    constexpr std::uint32_t assignment = 7; // `12 A=0` and its line end
    const auto& reads = reads_[v];
    return reads.all > 0 && reads.all == reads.constant &&
           reads.digits <= reads.all + assignment * reads.sets;
  }

  /// Which known numbers take the place of their variables. Negative ones are printed in
  /// parentheses, and so can be deeper than a variable; so can what folding makes of a term. With
  /// neither, a term is as deep as before: a variable that vanishes never has to stay.
  enum class Known : std::uint8_t { All, Positive, PositiveUnfolded };

  /// A term with numbers in place of variables that are known.
  std::uint32_t replaced(std::uint32_t term, const State& state) {
    for (const auto known : {Known::All, Known::Positive, Known::PositiveUnfolded})
      if (const auto result = replaced(term, state, known); !is_too_deep(result))
        return result;
    return term;
  }

  std::uint32_t replaced(std::uint32_t term, const State& state, Known known) {
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
      const auto most = spec::value_of(spec::Limit::IndexedVariables);
      const auto index = state[index_variable];
      if (index.lo >= 1 && index.hi <= most)
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

  bool is_too_deep(std::uint32_t term) const {
    return code_.terms[term].levels > spec::value_of(spec::Limit::ExpressionLevels);
  }

  /// The same term over other operands, as it stands: folding can turn it into a deeper one.
  std::uint32_t unfolded(Term node, std::uint32_t left, std::uint32_t right) {
    node.left = left;
    node.right = right;
    node.levels = levels_of(code_, static_cast<Operator>(node.what), left, right);
    return code_.add(node);
  }

  /// Forgets faults that cannot happen.
  void improve(std::uint32_t term, const State& state) {
    auto& node = code_.terms[term];
    if (node.kind == TermKind::Binary) {
      const auto op = static_cast<Operator>(node.what);
      const auto right = range_of(node.right, state);
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
      const auto operand = range_of(node.left, state);
      const bool faults = operand.lo < spec::info(function).least;
      node.effects =
          static_cast<std::uint8_t>(code_.terms[node.left].effects | (faults ? effect::faults : 0) |
                                    (function == spec::Function::Rnd ? effect::clears : 0));
    }
  }

  void rewrite() {
    std::vector<bool> reached(code_.lines.size(), false);
    each_state([&](std::uint32_t i, State& state) {
      reached[i] = true;
      auto& line = code_.lines[i];
      if (line.kind == LineKind::If)
        learn(line, state);
      each_root(code_, line, [&](std::uint32_t& root) {
        // The end of a loop is computed when its variable has been set.
        if (line.kind == LineKind::For && &root == &line.end)
          state[line.variable] = range_of(line.term, state);
        root = replaced(root, state);
      });
      if (line.kind == LineKind::If)
        decide(line, state);
      if (line.kind == LineKind::Print || line.kind == LineKind::Do)
        for (auto n = line.parts_begin; n < line.parts_end; ++n)
          if (code_.parts[n].kind == PartKind::Term)
            code_.parts[n].range = range_of(code_.parts[n].value, state);
      if (line.kind == LineKind::Switch)
        choose(i, state[line.variable]);
    });
    each_state([&](std::uint32_t i, const State& state) {
      auto& line = code_.lines[i];
      if (line.kind == LineKind::Let && line.variable != index_variable &&
          state[line.variable].constant() && code_.is_number(line.term) &&
          code_.terms[line.term].value == state[line.variable].lo)
        line.kind = LineKind::Nothing;
    });
    cut_unreached(reached);
    add_lines();
  }

  /// What no values come to never runs, behind a sub that always ends the program, say.
  void cut_unreached(const std::vector<bool>& reached) {
    for (const auto& block : flow_.blocks) {
      bool cut = false;
      for (auto i = block.begin; i < block.end; ++i) {
        auto& line = code_.lines[i];
        if (reached[i] || line.kind == LineKind::Label || line.kind == LineKind::Nothing)
          continue;
        line.kind = cut ? LineKind::Nothing : LineKind::Do;
        line.robot = spec::Statement::End;
        line.parts_begin = line.parts_end = 0;
        cut = true;
      }
    }
  }

  void learn(CodeLine& line, const State& state) {
    auto& condition = code_.conditions[line.condition];
    condition.first.left_range = range_of(condition.first.left, state);
    condition.first.right_range = range_of(condition.first.right, state);
    if (condition.glue == Glue::None)
      return;
    condition.second.left_range = range_of(condition.second.left, state);
    condition.second.right_range = range_of(condition.second.right, state);
  }

  void decide(CodeLine& line, const State& state) {
    auto& condition = code_.conditions[line.condition];
    if (condition.glue != Glue::None)
      return;
    auto& relation = condition.first;
    const auto outcome = outcome_of(relation.comparison, range_of(relation.left, state),
                                    range_of(relation.right, state));
    // An index that is wrong for certain stays a test, and the robot finds it.
    const bool to_good = relation.comparison == Comparison::LessEqual ||
                         relation.comparison == Comparison::GreaterEqual;
    const bool always = outcome == Outcome::Always && (!line.guard || to_good);
    const bool never = outcome == Outcome::Never && (!line.guard || !to_good);
    const auto effects = code_.terms[relation.left].effects | code_.terms[relation.right].effects;
    if ((always || never) && (effects & (effect::faults | effect::clears)) != 0)
      keep_computing(line, outcome);
    else if (always)
      line.kind = LineKind::Goto;
    else if (never)
      line.kind = LineKind::Nothing;
  }

  /// A test whose outcome is known but whose terms do something: it leads to the next line, from
  /// where the way goes on.
  void keep_computing(CodeLine& line, Outcome outcome) {
    auto after = line;
    after.kind = LineKind::Label;
    after.label = code_.labels++;
    const auto place = static_cast<std::uint32_t>(&line - code_.lines.data()) + 1;
    added_.push_back({place, after});
    if (outcome == Outcome::Always) {
      auto jump = line;
      jump.kind = LineKind::Goto;
      added_.push_back({place, jump});
    }
    line.label = after.label;
  }

  void add_lines() {
    for (auto added = added_.rbegin(); added != added_.rend(); ++added)
      code_.lines.insert(code_.lines.begin() + added->first, added->second);
  }

  /// A choice among neighbouring numbers, where no other can come, is the robot's `on`.
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

  struct Returned {
    State state;                        ///< empty: it has not come back yet
    std::vector<std::uint32_t> callers; ///< blocks
  };

  Code& code_;
  Flow flow_;
  std::vector<State> states_; ///< at the begin of each block; empty: not reached
  std::vector<std::uint32_t> visits_;
  std::vector<bool> waiting_;
  std::vector<std::uint32_t> work_;
  std::vector<Range> ends_; ///< of each loop's label: its end value
  std::vector<Returned> returns_;
  std::vector<std::int32_t> landmarks_;
  std::vector<Reads> reads_;
  std::vector<std::pair<std::uint32_t, CodeLine>> added_; ///< lines, each to stand before another
  Range data_;
};

} // namespace

void use_values(Code& code) {
  Values(code).run();
}

} // namespace orb::structured
