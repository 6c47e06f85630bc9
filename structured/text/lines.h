#pragma once

#include "structured/text/foreign_words.h"
#include "structured/text/matching.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace orb::structured {

/// The position of a statement: a branch of a one-line `if` accepts fewer.
enum class Position : std::uint8_t { Line, Branch };

/// Parses the statements of a file in sequence. Large because each form of line has its own parser.
class Lines {
public:
  Lines(Program& program, const char* begin, const char* end);

  void parse();

private:
  Span span(std::string_view text) const;
  const char* parse_line(const char* p);

  /// Reports the first numbered line; the others are numbered for the same reason.
  const char* numbered(const char* p);

  /// Where parsing resumes after an error: at the end of the line with the error, unless that line
  /// only continues because a bracket was never closed.
  const char* resume(const char* begin, const char* at) const;

  /// True if the text at `at` is on a later line than `last` and is a word that can only begin a
  /// statement.
  bool begins_statement(const char* last, const char* at) const;

  static bool at_end(const Input& in);

  template <typename Rule>
  void tail(Input& in) {
    if (!tao::pegtl::parse<Rule, Action, Control>(in, builder_))
      throw ParseStop{reason<Rule>, in.current()};
  }

  /// Begins a statement at its word, which was only peeked at.
  Statement& begin(Input& in, Kind kind, std::string_view word);
  template <typename Rule>
  void simple(Input& in, Kind kind, std::string_view word) {
    begin(in, kind, word);
    tail<Rule>(in);
    builder_.finish(in.current());
  }
  void bare(Input& in, Kind kind, std::string_view word);

  void statement(Input& in, Position position);
  /// Parses a statement that begins with `word` as if it began with `ours`.
  void meant(Input& in, std::string_view word, std::string_view ours, Position position);

  void only_on_line(Position position, std::string_view word) const;
  void repeat_line(Input& in, std::string_view word);

  /// `local a, b = 5`: a variable with a value is assigned at once.
  void local_line(Input& in, std::string_view word);

  void case_line(Input& in, std::string_view word);
  void keyword(Input& in, Keyword keyword, std::string_view word, Position position);

  /// `if` and `elseif`: a condition and `then`.
  void conditional(Input& in, Kind kind, std::string_view word);

  void robot(Input& in, spec::Statement robot, std::string_view word, Position position);
  void print_line(Input& in, std::string_view word);
  void if_line(Input& in, std::string_view word, Position position);

  /// `end`, or `end` and the word of its block.
  void end_line(Input& in, std::string_view word, Position position);

  // ---- names at the start of a line

  void named(Input& in, std::string_view name, Position position);
  void set_name(std::string_view name);
  void assignment(Input& in);
  void call(Input& in, std::string_view name, char next);

  // ---- syntax of other languages (structured/text/foreign_words.h)

  /// Skips a foreign comment; `line` is the start of its line.
  bool skip_remark(Input& in, const char* line);

  /// Skips a foreign sign at the end of a line; `instead` replaces it.
  bool skip_last(Input& in, std::string_view instead);

  /// Parses a statement that begins with foreign words as their native equivalent.
  bool foreign(Input& in, std::string_view first, Position position);

  /// `break` at the end of a `case`.
  void leave_case(Input& in, std::string_view word, Position position);

  /// Turns a `do` with its condition at the end into a `repeat`.
  void end_do(const Foreign& row);

  /// True if the body of a `def` returns a value before the next one begins.
  bool gives_value(const char* p) const;

  /// Tracks the blocks that are open after the statements of a line.
  void note_blocks(std::size_t from, std::string_view line);

  struct Do {
    std::size_t statement;
    std::size_t finding; ///< a Diagnostic
  };

  Program& program_;
  Builder builder_;
  const char* begin_;
  const char* end_;
  std::vector<Kind> open_; ///< the open blocks, innermost last; Broken: foreign ones, in braces
  std::vector<Do> dos_;    ///< each `do` still without its `loop`
  bool numbered_ = false;  ///< a numbered line was seen
};

} // namespace orb::structured
