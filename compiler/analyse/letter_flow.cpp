#include "compiler/analyse/letter_flow.h"

#include <algorithm>

namespace orb::compiler {
namespace {

constexpr std::uint32_t most_lines = 2048; ///< more than fit into any robot
constexpr std::size_t most_routines = 64;

} // namespace

void join_into(LetterValues& into, const LetterValues& from) {
  for (std::size_t i = 0; i < into.size(); ++i)
    if (!(into[i] == from[i]))
      into[i] = join(into[i], from[i]);
}

void LetterFlow::keep(std::uint32_t code) {
  if (block_of_[code] != none)
    return;
  block_of_[code] = static_cast<std::uint32_t>(blocks_.size());
  blocks_.emplace_back().code = code;
}

bool LetterFlow::prepare() {
  const auto size = static_cast<std::uint32_t>(flow_.code.size());
  block_of_.assign(size, none);
  if (size == 0 || size > most_lines)
    return false;
  keep(0);
  for (std::uint32_t i = 1; i < size; ++i) {
    const auto& above = program_.statements[flow_.code[i - 1].statement];
    if (flow_.code[i].target || !flow_.code[i - 1].falls || above.error ||
        above.kind == spec::Statement::For)
      keep(i);
  }
  for (const auto& statement : program_.statements) {
    if (statement.error || statement.kind != spec::Statement::Sleep)
      continue;
    const auto& line = program_.nodes[program_.as<SleepView>(statement).line.value];
    if (line.kind != NodeKind::Number || line.value > 0)
      return false; // it may wake up at any line
  }
  find_routines();
  if (routines_.size() > most_routines)
    return false;
  find_landmarks();
  return true;
}

void LetterFlow::find_routines() {
  for (std::uint32_t i = 0; i < flow_.code.size(); ++i)
    if (flow_.code[i].called)
      routines_.emplace_back().entry = i;
  if (routines_.size() > most_routines)
    return;
  for (auto& routine : routines_)
    read_routine(routine);
  const auto written_by_routine = [&](std::uint32_t entry) {
    for (const auto& routine : routines_)
      if (routine.entry == entry)
        return routine.written;
    return LetterSet{0};
  };
  for (bool changed = true; changed;) { // closure: add what their callees write
    changed = false;
    for (auto& routine : routines_)
      for (const auto callee : routine.callees) {
        const auto all = routine.written | written_by_routine(callee);
        changed = changed || all != routine.written;
        routine.written = all;
      }
  }
}

void LetterFlow::read_routine(Routine& routine) {
  const auto size = static_cast<std::uint32_t>(flow_.code.size());
  routine.lines.assign(size, 0);
  std::vector<std::uint32_t> open{routine.entry};
  while (!open.empty()) {
    auto at = open.back();
    open.pop_back();
    for (; at < size && routine.lines[at] == 0; ++at) {
      routine.lines[at] = 1;
      const auto& code = flow_.code[at];
      routine.written |= written_by(at);
      for (const auto& jump : flow_.jumps_of(code))
        if (jump.to != none)
          (jump.call ? routine.callees : open).push_back(jump.to);
      if (!code.falls)
        break;
    }
  }
}

LetterSet LetterFlow::written_by(std::uint32_t code) const {
  LetterSet written = 0;
  for (const auto& statement : program_.whole(program_.statements[flow_.code[code].statement])) {
    if (statement.error)
      return ~LetterSet{0};
    for (const auto& item : program_.items_of(statement))
      if (item.kind == ItemKind::Letter)
        written |= bit(item.value);
  }
  return written;
}

void LetterFlow::find_landmarks() {
  std::vector<std::int32_t> named;
  for (const auto& statement : program_.statements)
    if (!statement.error &&
        (statement.kind == spec::Statement::If || statement.kind == spec::Statement::For ||
         statement.kind == spec::Statement::Let))
      for (const auto& item : program_.items_of(statement))
        if (item.kind == ItemKind::Expression)
          for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
            if (program_.nodes[n].kind == NodeKind::Number)
              named.push_back(program_.nodes[n].value);
  landmarks_ = landmarks_of(std::move(named));
}

const LetterValues* LetterFlow::before(std::uint32_t code) const {
  const auto& block = blocks_[block_of_[code]];
  return block.reached ? &block.letters : nullptr;
}

void LetterFlow::wait(std::uint32_t block) {
  blocks_[block].waiting = true;
  first_waiting_ = std::min(first_waiting_, block);
}

void LetterFlow::enter(std::uint32_t code, const LetterValues& letters) {
  if (code >= block_of_.size() || block_of_[code] == none)
    return; // no line, or one reached from the line above
  auto& block = blocks_[block_of_[code]];
  if (!block.reached) {
    block.reached = true;
    block.letters = letters;
    wait(block_of_[code]);
    return;
  }
  if (grow(block.letters, letters, block.visits))
    wait(block_of_[code]);
}

bool LetterFlow::grow(LetterValues& into, const LetterValues& from, std::uint32_t visits) const {
  constexpr std::uint32_t patience = 2;
  constexpr std::uint32_t limit = 24;
  bool changed = false;
  for (std::size_t i = 0; i < program_.letters; ++i) {
    if (into[i] == from[i])
      continue;
    auto joined = join(into[i], from[i]);
    if (visits > patience && !(joined.range == into[i].range))
      joined = {visits > limit ? Range{} : widen(landmarks_, into[i].range, joined.range), false,
                false, joined.driven, joined.narrowed};
    changed = changed || !(joined == into[i]);
    into[i] = joined;
  }
  return changed;
}

bool LetterFlow::call(std::uint32_t entry, std::uint32_t from, LetterValues& letters) {
  const auto routine = std::find_if(routines_.begin(), routines_.end(),
                                    [&](const Routine& one) { return one.entry == entry; });
  if (routine == routines_.end())
    return false;
  enter(entry, letters);
  const auto block = block_of_[from];
  if (std::find(routine->callers.begin(), routine->callers.end(), block) == routine->callers.end())
    routine->callers.push_back(block);
  if (!routine->returned)
    return false;
  for (std::size_t i = 0; i < program_.letters; ++i)
    if ((routine->written & bit(i)) != 0)
      letters[i] = routine->letters[i];
  return true;
}

void LetterFlow::leave(std::uint32_t code, const LetterValues& letters) {
  for (auto& routine : routines_) {
    if (routine.lines[code] == 0)
      continue;
    // The result of a recursive routine would grow by a step each time.
    const bool changed = !routine.returned || grow(routine.letters, letters, routine.growths);
    if (!routine.returned)
      routine.letters = letters;
    routine.growths += changed ? 1 : 0;
    routine.returned = true;
    if (changed)
      for (const auto caller : routine.callers)
        wait(caller);
  }
}

std::uint32_t LetterFlow::take() {
  for (; first_waiting_ < blocks_.size(); ++first_waiting_) {
    auto& block = blocks_[first_waiting_];
    if (!block.waiting)
      continue;
    block.waiting = false;
    ++block.visits;
    return block.code;
  }
  return none;
}

} // namespace orb::compiler
