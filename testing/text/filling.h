#pragma once

// Private to testing/.

#include "base/slots.h"
#include "base/time.h"
#include "testing/text/pieces.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orb::testing {

/// What the rest of the file says.
struct SurroundingText {
  Duration bound{}; ///< time limit of a run
  bool has_course = false;
  bool may_have_zones = false;
  std::string near_by;    ///< tolerance of the last place; empty without one
  std::string heading_by; ///< tolerance of the last heading; empty without one
  bool has_bound = false; ///< the file sets a time limit
  bool has_texts = false; ///< has lines that begin with a quote, like those below `prints`
};

/// When, as the line says it.
struct SaidWhen {
  /// `within`, `at`, `during`, `until`, `after`; empty if there is only a time
  std::string_view word;
  std::string time; ///< or `end`
};

/// A time as test files write it. A number without a unit is seconds, a large one milliseconds.
std::string time_of(const Amount& amount);

/// A whole angle from 0 to 359.
std::string in_circle(const std::string& degrees);

/// The file that a piece names; empty if it names none.
std::string file_of(const Piece& piece);

/// Assigns the pieces of a line, in any order, to the slots of a word. Large because each kind of
/// slot has its own member.
class Filling {
public:
  Filling(const Pieces& pieces, const SurroundingText& elsewhere)
      : pieces_(pieces), elsewhere_(elsewhere), used_(pieces.size()) {}

  bool is_used(std::size_t at) const { return used_[at]; }
  void use(std::size_t at) { used_[at] = true; }
  /// True if everything filled in was written in the line.
  bool is_sure() const { return sure_; }

  /// Returns the values of a word in the order of its slots; nothing if one is missing. The word
  /// itself may be at `subject`.
  std::optional<std::string> fill(const Slots& slots, std::size_t subject);

  std::string take_times(); ///< ` 3 times`, ` 1 to 6 times`; empty if not given
  std::string take_count(); ///< the same for a number without a word
  std::string take_name();  ///< of an error; empty if not given

  /// Takes everything that says when; false if that is more than one time.
  bool take_when(std::optional<SaidWhen>& when, std::string& lasts);

  /// `at 2s `, the start of a stimulus; empty if not given.
  std::string take_moment(const Slots& slots);

  /// True if nothing is lost: what is left has no meaning, or repeats `word`.
  bool is_empty(std::string_view word) const;

private:
  static constexpr std::size_t none = SIZE_MAX;

  /// The word that says what a piece is for: `by` in `by 5`; null if there is none.
  const Piece* front(std::size_t at) const;
  bool has_front(std::size_t at, std::string_view meanings) const;
  bool is_free(std::size_t at) const;
  bool is_number(std::size_t at) const;
  template <class Fits>
  std::size_t find(Fits fits) const;
  const Piece& take(std::size_t at);
  std::optional<std::string> value(const Slot& slot);
  std::optional<std::string> written(const Amount& amount, std::span<const Unit> units);
  std::optional<std::string> number(const Slot& slot);
  std::optional<std::string> place();
  std::optional<std::string> side(const Slot& slot);
  std::optional<std::string> name();
  std::optional<std::string> range(const Slot& slot);
  std::optional<std::string> colour();
  std::optional<std::string> seeds();

  Pieces pieces_;
  const SurroundingText& elsewhere_;
  std::vector<bool> used_;
  std::size_t subject_ = none;
  std::size_t by_ = none; ///< tolerance of a place
  bool sure_ = true;
};

} // namespace orb::testing
