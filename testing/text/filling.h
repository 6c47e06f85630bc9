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
struct Elsewhere {
  Duration bound{}; ///< after how long a run is stopped
  bool has_course = false;
  bool may_have_zones = false;
  std::string near_by;    ///< the tolerance of the last place; empty without one
  std::string heading_by; ///< the same of headings
  bool has_bound = false; ///< the file says how long a run is
  bool has_texts = false; ///< lines that begin with a quote, as those below `prints`
};

/// When, as it was said.
struct SaidWhen {
  std::string_view word; ///< `within`, `at`, `during`, `until`, `after`; empty where only a time is
  std::string time;      ///< or `end`
};

/// A time as test files write it; a number alone is seconds, a large one milliseconds.
std::string time_of(const Amount& amount);

/// A whole angle from 0 to 359.
std::string in_circle(const std::string& degrees);

/// The file that a piece names; empty where it names none.
std::string file_of(const Piece& piece);

/// Puts the pieces of a line into the slots of a word, in whatever order they stand.
class Filling {
public:
  Filling(const Pieces& pieces, const Elsewhere& elsewhere)
      : pieces_(pieces), elsewhere_(elsewhere), used_(pieces.size()) {}

  bool is_used(std::size_t at) const { return used_[at]; }
  void use(std::size_t at) { used_[at] = true; }
  /// Whether nothing was put in that nobody wrote.
  bool is_sure() const { return sure_; }

  /// The values behind a word, as its slots have them; nothing where one lacks. The word itself may
  /// stand at `subject`.
  std::optional<std::string> fill(const Slots& slots, std::size_t subject);

  std::string take_times(); ///< ` 3 times`, ` 1 to 6 times`; empty without
  std::string take_count(); ///< the same of a number alone
  std::string take_name();  ///< of an error; empty without

  /// Takes all that says when; false where several do.
  bool take_when(std::optional<SaidWhen>& when, std::string& lasts);

  /// `at 2s `, as a stimulus begins; empty without.
  std::string take_moment(const Slots& slots);

  /// Whether nothing was lost: what is left says nothing, or says again what `word` does.
  bool is_empty(std::string_view word) const;

private:
  static constexpr std::size_t none = SIZE_MAX;

  /// The word that says what a piece is for: `by` of `by 5`; null without.
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
  const Elsewhere& elsewhere_;
  std::vector<bool> used_;
  std::size_t subject_ = none;
  std::size_t by_ = none; ///< the tolerance of a place
  bool sure_ = true;
};

} // namespace orb::testing
