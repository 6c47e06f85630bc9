#pragma once

#include "structured/lower/code.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace orb::structured {

/// Sets of variables as consecutive bit sets.
class VariableSets {
public:
  VariableSets() = default;
  VariableSets(std::size_t sets, std::size_t variables)
      : words_((variables + 63) / 64), bits_(sets * words_, 0) {}

  std::span<std::uint64_t> operator[](std::size_t set) {
    return {bits_.data() + set * words_, words_};
  }
  std::span<const std::uint64_t> operator[](std::size_t set) const {
    return {bits_.data() + set * words_, words_};
  }
  std::size_t words() const { return words_; }

private:
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

inline void insert(std::span<std::uint64_t> set, std::uint32_t variable) {
  set[variable / 64] |= std::uint64_t{1} << (variable % 64);
}
inline void remove(std::span<std::uint64_t> set, std::uint32_t variable) {
  set[variable / 64] &= ~(std::uint64_t{1} << (variable % 64));
}
inline bool contains(std::span<const std::uint64_t> set, std::uint32_t variable) {
  return (set[variable / 64] >> (variable % 64) & 1) != 0;
}
template <typename Visit>
void each_member(std::span<const std::uint64_t> set, Visit visit) {
  for (std::uint32_t word = 0; word < set.size(); ++word)
    for (auto bits = set[word]; bits != 0; bits &= bits - 1)
      visit(word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
}
/// Adds all of `from`; returns true if the set changed.
inline bool unite(std::span<std::uint64_t> set, std::span<const std::uint64_t> from) {
  std::uint64_t changed = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    changed |= from[i] & ~set[i];
    set[i] |= from[i];
  }
  return changed != 0;
}

/// A basic block: lines that run in sequence. Calls are inside a block, since they return.
struct Block {
  std::uint32_t begin = 0; ///< lines
  std::uint32_t end = 0;
  std::uint32_t successors_begin = 0;
  std::uint32_t successors_end = 0;
};

/// The control flow of a program, and the variables that its routines use.
struct Flow {
  std::vector<Block> blocks;
  std::vector<std::uint32_t> successors;     ///< blocks
  std::vector<std::uint32_t> block_of_label; ///< or none
  std::vector<std::uint32_t> entries;        ///< of each routine: its first block, or none
  VariableSets written;                      ///< of each sub and function, including its callees
  VariableSets touched;                      ///< the same, read or written
  std::vector<bool> sets_elements;           ///< the same for elements

  std::span<const std::uint32_t> successors_of(const Block& block) const {
    return {successors.data() + block.successors_begin, successors.data() + block.successors_end};
  }
};

Flow read_flow(const Code& code);

/// True if the line itself sets an element.
bool sets_element(const Code& code, const CodeLine& line);

/// The number of references to each label.
std::vector<std::uint32_t> names_of_labels(const Code& code);

/// Calls `visit` with each label that a line can jump to.
template <typename C, typename L, typename Visit>
void each_target(C& code, L& line, Visit visit) {
  if (line.kind == LineKind::Goto || line.kind == LineKind::If || line.kind == LineKind::Next)
    visit(line.label);
  if (line.kind == LineKind::Switch) {
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      visit(code.cases[i].label);
    visit(line.label);
  }
  if (line.kind == LineKind::On)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      visit(code.parts[i].value);
}

/// The same, and also with the sub that a line calls.
template <typename C, typename L, typename Visit>
void each_label(C& code, L& line, Visit visit) {
  each_target(code, line, visit);
  if (line.kind == LineKind::Gosub)
    visit(line.label);
}

/// The routine that a line calls, or none.
inline std::uint32_t callee_of(const CodeLine& line) {
  return line.kind == LineKind::Gosub ? line.variable : none;
}

/// True if the program ends at the line.
inline bool ends_program(const CodeLine& line) {
  return line.kind == LineKind::Do && line.robot == spec::Statement::End;
}

/// True if the line below can follow.
inline bool falls_through(const CodeLine& line) {
  if (line.kind == LineKind::Do)
    return line.robot != spec::Statement::End && line.robot != spec::Statement::Reset;
  return line.kind != LineKind::Goto && line.kind != LineKind::Return &&
         line.kind != LineKind::Switch && line.kind != LineKind::On;
}

/// The live variables: read later before they are set again. Kept variables are live everywhere.
struct Liveness {
  VariableSets in;        ///< at the start of each block
  VariableSets out;       ///< at its end
  VariableSets across;    ///< of each routine: live across a call of it, unchanged
  VariableSets at_return; ///< of each routine: read after its calls
};

/// What counts as a use: reads only, or also assignments of a number, whose earlier value is
/// relevant because setting a variable to its current value is redundant.
enum class Counting : std::uint8_t { Reads, SettingsToo };

Liveness read_liveness(const Code& code, const Flow& flow, Counting counting = Counting::Reads);

/// Moves `live` from after `line` to before it.
void step_back(const Code& code, const Flow& flow, const Liveness& liveness, const CodeLine& line,
               std::span<std::uint64_t> live);

} // namespace orb::structured
