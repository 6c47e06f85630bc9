#include "structured/analyse/ranges.h"

#include <algorithm>
#include <limits>

namespace orb::structured {
namespace {

using compiler::Range;
using spec::Operator;

constexpr std::int32_t least_value = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t greatest_value = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t most_cells = std::size_t{1} << 21; ///< blocks times variables

template <typename Visit>
void each_number(const Code& code, std::uint32_t term, Visit visit) {
  const auto& node = code.terms[term];
  if (node.kind == TermKind::Number)
    visit(node.value);
  if (node.kind == TermKind::Binary || node.kind == TermKind::Call)
    each_number(code, node.left, visit);
  if (node.kind == TermKind::Binary)
    each_number(code, node.right, visit);
}

} // namespace

Range Ranges::range_of(std::uint32_t term, const VariableRanges& state) const {
  const auto& node = code_.terms[term];
  switch (node.kind) {
  case TermKind::Number: return Range::only(node.value);
  case TermKind::Variable: return state[node.left];
  case TermKind::Element: return elements_;
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

// ---- precomputed facts

/// Finds the variables whose values matter at the start of each block, and after each call.
void Ranges::find_tracked() {
  const auto liveness = read_liveness(code_, flow_, Counting::SettingsToo);
  std::vector<std::uint32_t> variables;
  const auto add = [&](std::uint32_t v) { variables.push_back(v); };
  for (std::uint32_t b = 0; b < flow_.blocks.size(); ++b) {
    variables.clear();
    each_member(liveness.in[b], add);
    states_.add_block(variables);
  }
  for (std::size_t r = 0; r < code_.routines.size(); ++r) {
    variables.clear();
    each_member(flow_.written[r], [&](std::uint32_t v) {
      if (contains(liveness.at_return[r], v))
        add(v);
    });
    states_.add_routine(flow_.entries[r], variables);
  }
}

/// The thresholds of widening: numbers in tests, loops and assignments, and their neighbours.
void Ranges::find_landmarks() {
  std::vector<std::int32_t> named;
  for (const auto& line : code_.lines)
    if (line.kind == LineKind::If || line.kind == LineKind::For || line.kind == LineKind::Let)
      each_root(code_, line, [&](std::uint32_t root) {
        each_number(code_, root, [&](std::int32_t value) { named.push_back(value); });
      });
  states_.set_landmarks(compiler::landmarks_of(std::move(named)));
}

void Ranges::find_data() {
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

// ---- the states of blocks

bool Ranges::follow() {
  const auto blocks = flow_.blocks.size();
  if (blocks * code_.variables.size() > most_cells)
    return false;
  find_tracked();
  find_landmarks();
  find_data();
  for (std::uint32_t b = 0; b < blocks; ++b)
    for (auto i = flow_.blocks[b].begin; i < flow_.blocks[b].end; ++i)
      if ((effects_of(code_, code_.lines[i]) & effect::elements) != 0) {
        element_readers_.push_back(b);
        break;
      }
  ends_.assign(code_.labels, Range{greatest_value, least_value});
  nexts_.assign(code_.labels, none);
  for (std::uint32_t b = 0; b < blocks; ++b)
    if (const auto& last = code_.lines[flow_.blocks[b].end - 1]; last.kind == LineKind::Next)
      nexts_[last.label] = b;
  if (blocks == 0)
    return true;
  following_ = true;
  state_.assign(code_.variables.size(), Range::only(0));
  enter(0, state_);
  for (auto b = states_.take(); b != none; b = states_.take())
    visit(b);
  following_ = false;
  return true;
}

void Ranges::enter(std::uint32_t b, const VariableRanges& state) {
  if (b != none)
    states_.enter(b, state);
}

void Ranges::visit(std::uint32_t b) {
  const auto& block = flow_.blocks[b];
  states_.load(b, state_);
  for (auto i = block.begin; i < block.end; ++i)
    if (!step(b, code_.lines[i], state_))
      return;
  leave(b, code_.lines[block.end - 1], state_);
}

// ---- lines

/// Executes a line on the state; returns false if its call has not returned yet.
bool Ranges::step(std::uint32_t b, const CodeLine& line, VariableRanges& state) {
  if (const auto callee = callee_of(line); callee != none)
    return following_ ? states_.call(callee, b, state) : states_.load_returned(callee, state);
  set(line, state);
  return true;
}

/// Joins a value into the range of all array elements; blocks that read one are visited again.
void Ranges::set_element(Range range) {
  const auto joined = compiler::join(elements_, range);
  if (!following_ || joined == elements_)
    return;
  elements_ = compiler::widened(states_.landmarks(), elements_, joined, ++growths_ / 2);
  for (const auto b : element_readers_)
    if (reaches(b))
      states_.wait(b);
}

void Ranges::set(const CodeLine& line, VariableRanges& state) {
  if (line.kind == LineKind::SetElement)
    set_element(range_of(line.term, state));
  if (line.kind == LineKind::Let) {
    state[line.variable] = range_of(line.term, state);
  } else if (line.kind == LineKind::For) {
    // Enter the body with all values of the variable at once: one at a time would take a round
    // each.
    const auto begin = state[line.variable] = range_of(line.term, state);
    const auto end = range_of(line.end, state);
    const auto joined = compiler::join(ends_[line.label], end);
    if (following_ && !(joined == ends_[line.label])) {
      ends_[line.label] = joined;
      if (const auto next = nexts_[line.label]; next != none && reaches(next))
        states_.wait(next); // it now leaves the loop with another value
    }
    state[line.variable] = line.step > 0 ? Range{begin.lo, std::max(begin.hi, end.hi)}
                                         : Range{std::min(begin.lo, end.lo), begin.hi};
  } else if (line.kind == LineKind::Do) {
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code_.parts[i].kind == PartKind::Variable)
        state[code_.parts[i].value] = line.robot == spec::Statement::Read ? data_ : Range{};
      else if (code_.parts[i].kind == PartKind::Element)
        set_element(line.robot == spec::Statement::Read ? data_ : Range{});
  }
}

// ---- edges between blocks

void Ranges::leave(std::uint32_t b, const CodeLine& line, VariableRanges& state) {
  const auto& block = flow_.blocks[b];
  if (line.kind == LineKind::If)
    return leave_if(b, line, state);
  if (line.kind == LineKind::Next)
    return leave_next(b, line, state);
  if (line.kind == LineKind::Switch)
    return leave_switch(line, state);
  if (line.kind == LineKind::On)
    return leave_on(line, state);
  if (line.kind == LineKind::Return)
    return states_.leave(line.routine, state);
  for (const auto next : flow_.successors_of(block))
    enter(next, state);
}

bool Ranges::narrow(const Relation& relation, Comparison comparison, VariableRanges& state) const {
  const auto left = range_of(relation.left, state);
  const auto right = range_of(relation.right, state);
  const auto narrowed = where(comparison, left, right);
  const auto mirror = where(mirrored(comparison), right, left);
  if (!narrowed || !mirror)
    return false;
  const auto put = [&](std::uint32_t term, Range range) {
    if (code_.terms[term].kind == TermKind::Variable)
      state[code_.terms[term].left] = range;
  };
  put(relation.left, *narrowed);
  put(relation.right, *mirror);
  return true;
}

/// Enters a block with the state narrowed by a relation, unless the relation cannot hold.
void Ranges::enter_where(const Relation& relation, Comparison comparison, std::uint32_t b,
                         VariableRanges& state) {
  std::pair<std::uint32_t, Range> before[2];
  std::size_t count = 0;
  for (const auto term : {relation.left, relation.right})
    if (code_.terms[term].kind == TermKind::Variable)
      before[count++] = {code_.terms[term].left, state[code_.terms[term].left]};
  if (!narrow(relation, comparison, state))
    return;
  enter(b, state);
  while (count-- > 0)
    state[before[count].first] = before[count].second;
}

void Ranges::leave_if(std::uint32_t b, const CodeLine& line, VariableRanges& state) {
  const auto& condition = code_.conditions[line.condition];
  const auto target = flow_.block_of_label[line.label];
  const auto next = b + 1 < flow_.blocks.size() ? b + 1 : none;
  if (condition.glue != Glue::None) {
    enter(target, state);
    enter(next, state);
    return;
  }
  enter_where(condition.first, condition.first.comparison, target, state);
  enter_where(condition.first, opposite(condition.first.comparison), next, state);
}

void Ranges::leave_next(std::uint32_t b, const CodeLine& line, VariableRanges& state) {
  const auto stepped = compiler::apply(Operator::Add, state[line.variable], Range::only(line.step));
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

void Ranges::leave_switch(const CodeLine& line, VariableRanges& state) {
  const auto chosen = state[line.variable];
  auto others = std::int64_t{chosen.hi} - chosen.lo + 1; // values without a case
  for (auto i = line.parts_begin; i < line.parts_end; ++i) {
    const auto& one = code_.cases[i];
    if (chosen.misses(one.lo, one.hi))
      continue;
    const Range common{std::max(chosen.lo, one.lo), std::min(chosen.hi, one.hi)};
    others -= std::int64_t{common.hi} - common.lo + 1;
    state[line.variable] = common;
    enter(flow_.block_of_label[one.label], state);
  }
  state[line.variable] = chosen;
  if (others > 0)
    enter(flow_.block_of_label[line.label], state);
}

/// An `on` of a variable, or of one plus a constant, fixes its value at each target.
void Ranges::leave_on(const CodeLine& line, VariableRanges& state) {
  const auto sum = sum_of(code_, line.term);
  const bool steps = sum.base != none && code_.terms[sum.base].kind == TermKind::Variable;
  const auto variable = steps ? code_.terms[sum.base].left : none;
  const auto before = variable == none ? Range{} : state[variable];
  for (auto i = line.parts_begin; i < line.parts_end; ++i) {
    const auto index = static_cast<std::int32_t>(i - line.parts_begin) + 1;
    if (variable != none)
      state[variable] = Range::only(static_cast<std::int32_t>(index - sum.number));
    if (variable == none || !before.misses(state[variable].lo, state[variable].hi))
      enter(flow_.block_of_label[code_.parts[i].value], state);
  }
  if (variable != none)
    state[variable] = before;
}

std::optional<bool> answer_of(const Ranges& ranges, const Relation& relation,
                              const VariableRanges& state) {
  return compiler::answer_of(relation.comparison, ranges.range_of(relation.left, state),
                             ranges.range_of(relation.right, state));
}

std::uint32_t chosen_label(const Code& code, const Ranges& ranges, const CodeLine& on,
                           const VariableRanges& state) {
  const auto chosen = ranges.range_of(on.term, state);
  const auto count = static_cast<std::int32_t>(on.parts_end - on.parts_begin);
  if (!chosen.constant() || chosen.lo < 1 || chosen.lo > count)
    return none;
  return code.parts[on.parts_begin + static_cast<std::uint32_t>(chosen.lo) - 1].value;
}

} // namespace orb::structured
