#pragma once

#include "base/cursor.h"
#include "base/duration.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "repair/repair.h"
#include "spec/limits.h"
#include "structured/text/words.h"
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

/// A column of a table: its words.
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

/// What was written of an expectation's place in time and number.
struct Said {
  Span when{};  ///< empty: nothing
  Span times{}; ///< empty: nothing
  Span order{}; ///< empty: nothing
};

class FileReader {
public:
  explicit FileReader(const Source& source) : source_(source) {}

  TestFile read();

private:
  std::string_view first_word(std::uint32_t line);

  Test new_test() const;

  void read_line(std::uint32_t line);

  /// A line goes above the first test.
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

  /// In a room: of which ball it is expected. False, and a finding, where none is named.
  bool read_whose(Cursor& cursor, Expectation& one);

  // Tests.

  Test& current() { return file_.tests.back(); }

  void read_test(Cursor& cursor, Span span, std::uint32_t line);

  /// What only the whole file can say about a test.
  void complete(Test& test);

  // Expectations.

  void read_reach(Cursor& cursor, Span span, std::uint32_t line);

  void read_expectation(Cursor& cursor, Span span, std::uint32_t line, bool never);

  /// The word of what is expected; false, and a finding, where it is none.
  static bool read_what(Cursor& cursor, Expectation& one);

  static void unknown_expectation(Cursor& cursor, std::string_view word);

  /// Whether `NAME =` stands here; the cursor stays where it is.
  static bool begins_variable(Cursor& cursor);

  void read_operands(Cursor& cursor, Expectation& one);

  void take(Cursor& cursor, Expectation& one, const Slot& slot, const SlotValue& value);

  static void take_match(Cursor& cursor, Expectation& one, const SlotValue& value);

  void take_color(Cursor& cursor, Expectation& one, const SlotValue& value);

  void read_error(Cursor& cursor, Expectation& one);

  // How often and when.

  static bool is_when(std::string_view word);

  static bool is_join(std::string_view word);

  /// Whether `TIME after` stands here.
  static bool is_lag(Cursor& cursor);

  /// Whether `N times` or `A to B times` stands here.
  static bool is_times(Cursor& cursor);

  void read_times(Cursor& cursor, Expectation& one, Said& said);

  void read_when(Cursor& cursor, Expectation& one, Said& said);

  /// `and STATE`.
  void read_joined(Cursor& cursor, Expectation& one, const Said& said);

  /// `for TIME`.
  static void read_lasts(Cursor& cursor, Expectation& one);

  /// `after WHAT` and `before WHAT`.
  void read_order(Cursor& cursor, Expectation& one, Said& said);

  void finish(Cursor& cursor, Expectation& one, Span span, std::uint32_t line);

  /// Whether `after` and `before` fit the rest.
  static void check_order(Cursor& cursor, const Expectation& one, const Said& said);

  static void left_over(Cursor& cursor, const Expectation& one);

  /// Whether what was said of time fits the word.
  static void check_when(Cursor& cursor, const Expectation& one, const Said& said, Span first);

  const Source& source_;
  TestFile file_;
  bool has_tests_ = false;
  bool prints_ = false; ///< the last expectation is `prints`, and its lines may follow
  std::optional<Seeds> seeds_;
  std::optional<Duration> bound_;
  std::vector<vm::TimedStimulus> head_; ///< the stimuli of every test
  std::vector<std::string> head_lines_;
};

} // namespace orb::testing
