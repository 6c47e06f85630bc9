#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/analyse/states.h"
#include "spec/limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace orb::compiler {

/// A set of letters, one bit each.
using LetterSet = std::uint64_t;
static_assert(most_letters <= 64);

/// The set of one letter.
constexpr LetterSet bit(std::size_t letter) {
  return LetterSet{1} << letter;
}

/// The values of the letters at a program point.
using LetterValues = std::array<Value, most_letters>;

/// Those at the start of a program.
inline LetterValues all_zero() {
  LetterValues letters;
  letters.fill(Value::only(0));
  return letters;
}

/// Joins the values of another path into `into`.
void join_into(LetterValues& into, const LetterValues& from);

/// What is known of the letters at the lines where paths meet. The caller evaluates the lines
/// between.
class LetterFlow {
public:
  LetterFlow(const Program& program, const Flow& flow) : program_(program), flow_(flow) {}

  /// Finds these lines. Keeps so many letters, at least those of the program: the others stand for
  /// what else is known. Returns false if the program is too large for any robot: then nothing is
  /// known.
  bool prepare(std::uint32_t letters);

  bool is_kept(std::uint32_t code) const { return block_of_[code] != none; }
  /// Sets the letters to the state before a kept line; returns false if it is unreachable.
  bool load(std::uint32_t code, LetterValues& letters) const;

  /// Adds a path that reaches the line with this state.
  void enter(std::uint32_t code, const LetterValues& letters);
  /// Calls the subroutine at `entry` from the block that begins at `from`: changes `letters` to the
  /// state after it. Returns false if it has not returned yet.
  bool call(std::uint32_t entry, std::uint32_t from, LetterValues& letters);
  /// Adds the state at the `return` at `code`.
  void leave(std::uint32_t code, const LetterValues& letters);

  /// Takes the next kept line to evaluate; `none` at the fixed point.
  std::uint32_t take();

private:
  struct Routine {
    std::uint32_t entry = 0;
    LetterSet written = 0;
    std::vector<std::uint8_t> lines;    ///< lines of its body
    std::vector<std::uint32_t> callees; ///< entries
    std::uint32_t calls = 0;            ///< places that call it
    bool reads = false;                 ///< its result may depend on the place
  };

  void keep(std::uint32_t code);
  bool find_routines();
  void read_routine(Routine& routine);
  LetterSet written_by(std::uint32_t code) const;
  void find_landmarks();

  const Program& program_;
  const Flow& flow_;
  std::uint32_t letters_ = 0;
  std::vector<std::uint32_t> block_of_; ///< by line of code, or none
  std::vector<std::uint32_t> blocks_;   ///< the first line of each
  std::vector<Routine> routines_;
  States<Value> states_; ///< by block and routine
};

} // namespace orb::compiler
