#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/analyse/range.h"
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

/// The set of all letters of a program.
inline LetterSet letters_of(const Program& program) {
  return program.letters == most_letters ? ~LetterSet{0} : bit(program.letters) - 1;
}

/// The analysis state of the letters at a program point.
struct LetterFacts {
  std::array<Range, most_letters> ranges{};
  LetterSet exact = 0;    ///< both ends of the range are values that occur
  LetterSet dense = 0;    ///< in addition, so are all values between, as for a sensor
  LetterSet narrowed = 0; ///< narrowed by a test, so perhaps to values that never occur

  static LetterFacts zero() {
    LetterFacts letters;
    letters.ranges.fill(Range::only(0));
    letters.exact = ~LetterSet{0};
    return letters;
  }
};

/// Joins these letters of `from` into `into`; the others must already be equal. Returns true if a
/// range changed.
bool join_into(LetterFacts& into, const LetterFacts& from, LetterSet letters);

/// The fixed point of a data-flow analysis: keeps the state of the letters at the lines where paths
/// meet. The caller evaluates the lines between.
class LetterFlow {
public:
  LetterFlow(const Program& program, const Flow& flow) : program_(program), flow_(flow) {}

  /// Finds these lines. Returns false if the program is too large for any robot: then nothing is
  /// known.
  bool prepare();

  bool is_kept(std::uint32_t code) const { return block_of_[code] != none; }
  /// The state before a kept line; null if it is unreachable.
  const LetterFacts* before(std::uint32_t code) const;

  /// Adds a path that reaches the line with this state.
  void enter(std::uint32_t code, const LetterFacts& letters);
  /// Calls the subroutine at `entry` from the block that begins at `from`: changes `letters` to the
  /// state after it. Returns false if it has not returned yet.
  bool call(std::uint32_t entry, std::uint32_t from, LetterFacts& letters);
  /// Adds the state at the `return` at `code`.
  void leave(std::uint32_t code, const LetterFacts& letters);

  /// Takes the next kept line to evaluate; `none` at the fixed point.
  std::uint32_t take();

private:
  struct Block {
    std::uint32_t code = 0;
    std::uint32_t visits = 0;
    bool reached = false;
    bool waiting = false;
    LetterFacts letters;
  };
  struct Routine {
    std::uint32_t entry = 0;
    LetterSet written = 0;
    bool returned = false;
    LetterFacts letters;                ///< at its returns
    std::uint32_t growths = 0;          ///< how often the state grew
    std::vector<std::uint32_t> callers; ///< blocks
    std::vector<std::uint8_t> lines;    ///< lines of its body
    std::vector<std::uint32_t> callees; ///< entries
  };

  void keep(std::uint32_t code);
  void find_routines();
  void read_routine(Routine& routine);
  LetterSet written_by(std::uint32_t code) const;
  void find_landmarks();
  void wait(std::uint32_t block);
  /// Joins the state of another path into `into`, widening further with each visit. Returns true if
  /// that changed it.
  bool grow(LetterFacts& into, const LetterFacts& from, std::uint32_t visits) const;

  const Program& program_;
  const Flow& flow_;
  std::vector<std::uint32_t> block_of_; ///< by line of code, or none
  std::vector<Block> blocks_;
  std::vector<Routine> routines_;
  std::vector<std::int32_t> landmarks_; ///< numbers at which widened ranges stop first, ascending
  std::uint32_t first_waiting_ = 0;
};

} // namespace orb::compiler
