#pragma once

#include "base/cursor.h"
#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/repair.h"
#include "spec/limits.h"
#include "structured/text/structured_words.h"
#include "testing/text/rules.h"
#include "testing/text/test_file.h"
#include "testing/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace orb::testing {

template <class Row>
inline const Row* find_word(std::span<const Row> rows, std::string_view word) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.word == word; });
  return found == rows.end() ? nullptr : &*found;
}

/// The words in one column of a table.
template <class Rows, class Row>
std::vector<std::string_view> words_of(const Rows& rows, std::string_view Row::*column) {
  std::vector<std::string_view> words;
  for (const auto& row : rows)
    words.push_back(row.*column);
  return words;
}

/// `a, b, c`.
inline std::string listed(const std::vector<std::string_view>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// What a line says about an expectation's time and count.
struct GivenSpans {
  Span when{};  ///< empty: not written
  Span times{}; ///< empty: not written
  Span order{}; ///< empty: not written
};

/// Reads a test file line by line. Large because each kind of line and each part of an expectation
/// has its own reader.
class FileReader {
public:
  explicit FileReader(const Source& source) : source_(source) {}

  TestFile read();

private:
  std::string_view first_word(std::uint32_t line);

  Test new_test() const;

  void read_line(std::uint32_t line);

  /// Moves a line above the first test.
  Fix move_up(std::uint32_t line) const;

  void read_row(LineWord word, Cursor& cursor, Span span, std::uint32_t line);

  void end_of_line(Cursor& cursor);

  // Stimuli.

  void read_stimulus(Cursor& cursor, std::string_view word, std::uint32_t line);

  void unknown_word(Cursor& cursor, std::string_view word);

  // The head.

  void read_file(Cursor& cursor, const Slot& slot, std::optional<Named>& into);

  static Named named(const SlotValue& value);

  void read_target(Cursor& cursor, const SlotValue& value);

  void read_firmware(Cursor& cursor, const SlotValue& value);

  static std::optional<Seeds> read_seeds(Cursor& cursor, const SlotValue& value);

  static std::optional<Duration> read_bound(Cursor& cursor, const SlotValue& value);

  // Rooms.

  void read_ball(Cursor& cursor);

  std::optional<std::size_t> ball_called(std::string_view name) const;

  /// In a room: reads which ball it is about. False, with a finding, if none is named.
  bool read_whose(Cursor& cursor, Expectation& one);

  // Tests.

  Test& current() { return file_.tests.back(); }

  void read_test(Cursor& cursor, Span span, std::uint32_t line);

  /// Completes a test with what only the whole file can tell.
  void complete(Test& test);

  // Expectations.

  void read_reach(Cursor& cursor, Span span, std::uint32_t line);

  void read_expectation(Cursor& cursor, Span span, std::uint32_t line, bool never);

  /// Reads the word of an expectation; false, with a finding, if there is none.
  static bool read_what(Cursor& cursor, Expectation& one);

  static void unknown_expectation(Cursor& cursor, std::string_view word);

  /// True if `NAME =` follows; does not move the cursor.
  static bool begins_variable(Cursor& cursor);

  void read_operands(Cursor& cursor, Expectation& one);

  void take(Cursor& cursor, Expectation& one, const Slot& slot, const SlotValue& value);

  static void take_match(Cursor& cursor, Expectation& one, const SlotValue& value);

  void take_color(Cursor& cursor, Expectation& one, const SlotValue& value);

  void read_error(Cursor& cursor, Expectation& one);

  // Count and time.

  static bool is_when(std::string_view word);

  static bool is_join(std::string_view word);

  /// True if `TIME after` follows.
  static bool is_lag(Cursor& cursor);

  /// True if `N times` or `A to B times` follows.
  static bool is_times(Cursor& cursor);

  void read_times(Cursor& cursor, Expectation& one, GivenSpans& said);

  void read_when(Cursor& cursor, Expectation& one, GivenSpans& said);

  /// Reads `and STATE`.
  void read_joined(Cursor& cursor, Expectation& one, const GivenSpans& said);

  /// Reads `for TIME`.
  static void read_lasts(Cursor& cursor, Expectation& one);

  /// Reads `after WHAT` and `before WHAT`.
  void read_order(Cursor& cursor, Expectation& one, GivenSpans& said);

  void finish(Cursor& cursor, Expectation& one, Span span, std::uint32_t line);

  /// Reports `after` and `before` that do not fit the rest.
  static void check_order(Cursor& cursor, const Expectation& one, const GivenSpans& said);

  static void left_over(Cursor& cursor, const Expectation& one);

  /// Reports times that do not fit the word.
  static void check_when(Cursor& cursor, const Expectation& one, const GivenSpans& said,
                         Span first);

  const Source& source_;
  TestFile file_;
  bool has_tests_ = false;
  bool prints_ = false; ///< the last expectation is `prints`; its lines may follow
  std::optional<Seeds> seeds_;
  std::optional<Duration> bound_;
  std::vector<vm::TimedStimulus> head_; ///< stimuli for every test
  std::vector<std::string> head_lines_;
};

} // namespace orb::testing
