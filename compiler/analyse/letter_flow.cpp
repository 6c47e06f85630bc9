#include "compiler/analyse/letter_flow.h"

#include <algorithm>
#include <numeric>
#include <utility>

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
  std::vector<std::uint32_t> letters(letters_);
  std::iota(letters.begin(), letters.end(), 0U);
  block_of_[code] = static_cast<std::uint32_t>(blocks_.size());
  blocks_.push_back(code);
  states_.add_block(letters);
}

bool LetterFlow::prepare(std::uint32_t letters) {
  letters_ = std::max(letters, program_.letters);
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
  if (!find_routines())
    return false;
  find_landmarks();
  return true;
}

/// Returns false if there are too many.
bool LetterFlow::find_routines() {
  for (std::uint32_t i = 0; i < flow_.code.size(); ++i)
    if (flow_.code[i].called)
      routines_.emplace_back().entry = i;
  if (routines_.size() > most_routines)
    return false;
  for (auto& routine : routines_) {
    read_routine(routine);
    routine.calls = static_cast<std::uint32_t>(
        std::count_if(flow_.jumps.begin(), flow_.jumps.end(), [&](const Flow::Jump& jump) {
          return jump.call && jump.to == routine.entry;
        }));
  }
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
  for (const auto& routine : routines_) {
    std::vector<std::uint32_t> written;
    for (std::uint32_t letter = 0; letter < program_.letters; ++letter)
      if ((routine.written & bit(letter)) != 0)
        written.push_back(letter);
    states_.add_routine(block_of_[routine.entry], std::move(written));
  }
  return true;
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
      for (const auto& statement : program_.whole(program_.statements[code.statement]))
        for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n)
          routine.reads = routine.reads || program_.nodes[n].kind == NodeKind::Letter;
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
  states_.set_landmarks(landmarks_of(std::move(named)));
}

bool LetterFlow::load(std::uint32_t code, LetterValues& letters) const {
  states_.load(block_of_[code], letters);
  return states_.reaches(block_of_[code]);
}

void LetterFlow::enter(std::uint32_t code, const LetterValues& letters) {
  // Otherwise there is no line, or only the line above leads there.
  if (code < block_of_.size() && is_kept(code))
    states_.enter(block_of_[code], letters);
}

bool LetterFlow::call(std::uint32_t entry, std::uint32_t from, LetterValues& letters) {
  const auto routine = std::find_if(routines_.begin(), routines_.end(),
                                    [&](const Routine& one) { return one.entry == entry; });
  if (routine == routines_.end() ||
      !states_.call(static_cast<std::uint32_t>(routine - routines_.begin()), block_of_[from],
                    letters))
    return false;
  for (std::uint32_t letter = 0; routine->calls > 1 && routine->reads && letter < program_.letters;
       ++letter)
    if ((routine->written & bit(letter)) != 0 && !letters[letter].range.constant())
      letters[letter].exact = letters[letter].dense = false; // perhaps only after the other calls
  return true;
}

void LetterFlow::leave(std::uint32_t code, const LetterValues& letters) {
  for (std::uint32_t i = 0; i < routines_.size(); ++i)
    if (routines_[i].lines[code] != 0)
      states_.leave(i, letters);
}

std::uint32_t LetterFlow::take() {
  const auto block = states_.take();
  return block == none ? none : blocks_[block];
}

} // namespace orb::compiler
