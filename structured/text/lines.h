#pragma once

#include "structured/text/foreign.h"
#include "structured/text/matching.h"

#include <cstddef>
#include <cstdint>
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
  /// A statement that begins with `word`, as if that were `ours`.
  void meant(Input& in, std::string_view word, std::string_view ours, Position position);

  void only_on_line(Position position, std::string_view word) const;
  void repeat_line(Input& in, std::string_view word);

  /// `local a, b = 5`: what has a value is set right there.
  void local_line(Input& in, std::string_view word);

  void case_line(Input& in, std::string_view word);
  void keyword(Input& in, Keyword keyword, std::string_view word, Position position);

  /// `if` and `elseif`: a condition and `then`.
  void conditional(Input& in, Kind kind, std::string_view word);

  void robot(Input& in, spec::Statement robot, std::string_view word, Position position);
  void print_line(Input& in, std::string_view word);
  void if_line(Input& in, std::string_view word, Position position);

  /// `end`, or `end` and what it ends.
  void end_line(Input& in, std::string_view word, Position position);

  // ---- names at the beginning of a line

  void named(Input& in, std::string_view name, Position position);
  void set_name(std::string_view name);
  void assignment(Input& in);
  void call(Input& in, std::string_view name, char next);

  // ---- what other languages write (structured/text/foreign.h)

  /// A remark; `line` is where its line begins.
  bool skip_remark(Input& in, const char* line);

  /// A sign at the end of a line, in place of `instead`.
  bool skip_last(Input& in, std::string_view instead);

  /// A statement that begins with words of others: it is read as if they were ours.
  bool foreign(Input& in, std::string_view first, Position position);

  /// `break` at the end of a `case`.
  void leave_case(Input& in, std::string_view word, Position position);

  /// A `do` whose condition stands at its end is a `repeat`.
  void end_do(const Foreign& row);

  /// Whether what a `def` begins gives a value back before the next one begins.
  bool gives_value(const char* p) const;

  /// Keeps which blocks are open after the statements of a line.
  void note_blocks(std::size_t from, std::string_view line);

  struct Do {
    std::size_t statement;
    std::size_t finding; ///< a Diagnostic
  };

  Program& program_;
  Builder builder_;
  const char* begin_;
  const char* end_;
  std::vector<Kind> open_; ///< the blocks, innermost last; Broken: of others, in braces
  std::vector<Do> dos_;    ///< `do` without its `loop` yet
  bool numbered_ = false;  ///< a line with a number has been seen
};

} // namespace orb::structured
