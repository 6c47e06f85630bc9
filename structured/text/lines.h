#pragma once

#include "structured/text/matching.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace orb::structured {

/// Where a statement stands: a branch of a one-line `if` takes fewer.
enum class Position : std::uint8_t { Line, Branch };

/// Parses the statements of a file one after the other.
class Lines {
public:
  Lines(Program& program, const char* begin, const char* end);

  void parse();

private:
  Span span(std::string_view text) const;

  const char* parse_line(const char* p);

  /// A line with a number, which is said of the first one: the others have it for the same reason.
  const char* numbered(const char* p);

  /// Where parsing goes on after a line that does not parse: the end of the line on which it
  /// shows, unless that only goes on because a bracket was never closed.
  const char* resume(const char* begin, const char* at) const;

  /// Whether what stands at `at` is on another line than what ends at `last`, and a word that can
  /// only begin a statement.
  bool begins_statement(const char* last, const char* at) const;

  static bool at_end(const Input& in);

  /// `;` and `:` at the end of a line, which other languages want there.
  bool skip_foreign_end(Input& in, std::string_view instead = " ");

  /// `//` and `#` as they begin comments elsewhere, and `rem`.
  bool skip_foreign_comment(Input& in);
  /// Whether `//` stands between values: elsewhere it divides.
  bool divides(const char* sign, const char* line_end);

  template <typename Rule>
  void tail(Input& in) {
    if (!tao::pegtl::parse<Rule, Action, Control>(in, builder_))
      throw Stop{reason<Rule>, in.current()};
  }

  /// Begins a statement at its word, which has been looked at.
  Statement& begin(Input& in, Kind kind, std::string_view word);
  template <typename Rule>
  void simple(Input& in, Kind kind, std::string_view word) {
    begin(in, kind, word);
    tail<Rule>(in);
    builder_.finish(in.current());
  }
  void bare(Input& in, Kind kind, std::string_view word);

  void statement(Input& in, Position position);

  void only_on_line(Position position, std::string_view word) const;

  /// `exit` and `continue`, which may stand in a branch.
  void leave_line(Input& in, Kind kind, std::string_view word);

  /// `exit sub` and `exit function`.
  bool leave_routine(Input& in, std::string_view word, std::string_view routine);

  void repeat_line(Input& in, std::string_view word);

  /// `local a, b = 5`: what has a value is set right there.
  void local_line(Input& in, std::string_view word);

  /// `next`; also `next j, i`, which ends two loops elsewhere.
  void next_line(Input& in, std::string_view word);

  void select_line(Input& in, std::string_view word);

  void case_line(Input& in, std::string_view word);

  void keyword(Input& in, Keyword keyword, std::string_view word, Position position);

  /// `if` and `elseif`: a condition and `then`.
  void conditional(Input& in, Kind kind, std::string_view word);

  void else_line(Input& in, std::string_view word);

  /// `do`, `do while c` and `do until c`; their `loop` decides what they are.
  struct Do {
    std::uint32_t statement;
    std::size_t finding; ///< a Diagnostic
  };

  /// `loop` begins a block here and ends one elsewhere.
  void loop_line(Input& in, std::string_view word);

  /// `loop until c` and `loop while c`.
  void last_test(Input& in, std::string_view word, std::string_view after, bool until);

  /// The condition after `words` of another language, which is written after `instead` here: as it
  /// is, or its opposite.
  void condition(Input& in, Span words, bool as_is, std::string_view instead);

  void robot(Input& in, spec::Statement robot, std::string_view word, Position position);

  void print_line(Input& in, std::string_view word);

  /// `goroll(0, 80, 1)`: a parenthesis around several values and the whole rest of the line.
  void refuse_parentheses(const Input& in) const;

  void if_line(Input& in, std::string_view word, Position position);

  /// `end`, or `end` and what it ends.
  void end_line(Input& in, std::string_view word, Position position);

  // ---- names at the beginning of a line

  void named(Input& in, std::string_view name, Position position);

  void set_name(std::string_view name);

  void assignment(Input& in);

  /// `n++` and `n--`, with or without a blank before the signs.
  void step(Input& in, std::string_view name, std::string_view signs);

  void call(Input& in, std::string_view name, char next);

  bool do_line(Input& in, std::string_view name);

  /// Whether a `case` stands in the line below.
  bool begins_cases(const Input& in) const;

  /// The innermost open loop or `select`.
  std::optional<Kind> innermost() const;

  /// `var x = 1`, `let x = 1`, `call sub` and `dim a[3]`.
  bool declaration(Input& in, std::string_view name, Position position);

  /// What a word of another language begins, where that is a sub or a function.
  std::optional<Kind> foreign_routine(std::string_view word) const;

  /// Whether what a `def` begins gives a value back before it ends.
  bool gives_value(std::string_view word) const;

  /// `procedure name` and the like.
  bool routine_line(Input& in, std::string_view name, Kind kind, Position position);

  /// Statements of other languages; what has one meaning is taken with a finding.
  bool foreign(Input& in, std::string_view name, Position position);

  Program& program_;
  Builder builder_;
  const char* begin_;
  const char* end_;
  std::vector<Do> do_lines_; ///< without their `loop` yet
  bool numbered_ = false;    ///< a line with a number has been seen
};

} // namespace orb::structured
