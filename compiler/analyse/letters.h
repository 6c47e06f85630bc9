#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/analyse/range.h"
#include "spec/limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace orb::compiler {

/// A set of letters, a bit each.
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

/// What is known of the letters at a place of a program.
struct Letters {
  std::array<Range, most_letters> ranges{};
  LetterSet exact = 0;    ///< of these both ends of the range are values that they take
  LetterSet dense = 0;    ///< and of these all between, as of a sensor
  LetterSet narrowed = 0; ///< of these a test has left some, perhaps none that they ever have

  static Letters zero() {
    Letters letters;
    letters.ranges.fill(Range::only(0));
    letters.exact = ~LetterSet{0};
    return letters;
  }
};

/// Joins `from` into `into`, of these letters: the others are known to be the same. Whether that
/// changed a range.
bool join_into(Letters& into, const Letters& from, LetterSet letters);

/// The lines of a program at which what is known of its letters is kept, and what is known there
/// after all ways have been followed. The one who follows says what lines do.
class LetterFlow {
public:
  LetterFlow(const Program& program, const Flow& flow) : program_(program), flow_(flow) {}

  /// Finds the places. False for programs that are too large for any robot: nothing is known of
  /// them.
  bool prepare();

  bool is_kept(std::uint32_t code) const { return block_of_[code] != none; }
  /// What is known before a kept line; null where no way leads to it.
  const Letters* before(std::uint32_t code) const;

  /// A way leads to the line with this known.
  void enter(std::uint32_t code, const Letters& letters);
  /// A call of the lines at `entry`, made in the lines that begin at `from`: turns `letters` into
  /// what is known after it, false where nothing comes back yet.
  bool call(std::uint32_t entry, std::uint32_t from, Letters& letters);
  /// The `return` at `code` is reached.
  void leave(std::uint32_t code, const Letters& letters);

  /// The next kept line from which to go on; `none` when all ways have been followed.
  std::uint32_t take();

private:
  struct Block {
    std::uint32_t code = 0;
    std::uint32_t visits = 0;
    bool reached = false;
    bool waiting = false;
    Letters letters;
  };
  struct Routine {
    std::uint32_t entry = 0;
    LetterSet written = 0;
    bool returned = false;
    Letters letters;                    ///< at its returns
    std::uint32_t growths = 0;          ///< how often they became more
    std::vector<std::uint32_t> callers; ///< blocks
    std::vector<std::uint8_t> lines;    ///< that run in it
    std::vector<std::uint32_t> callees; ///< entries
  };

  void keep(std::uint32_t code);
  void find_routines();
  void read_routine(Routine& routine);
  LetterSet written_by(std::uint32_t code) const;
  void find_landmarks();
  void wait(std::uint32_t block);
  /// Joins what is known on another way, the rougher the more often; whether that is news.
  bool grow(Letters& into, const Letters& from, std::uint32_t visits) const;

  const Program& program_;
  const Flow& flow_;
  std::vector<std::uint32_t> block_of_; ///< by line of code, or none
  std::vector<Block> blocks_;
  std::vector<Routine> routines_;
  std::vector<std::int32_t> landmarks_; ///< numbers at which growing ranges stop first, ascending
  std::uint32_t first_waiting_ = 0;
};

} // namespace orb::compiler
