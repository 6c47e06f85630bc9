#pragma once

#include "compiler/lint/lint_passes.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/rules.h"
#include "compiler/text/words.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace orb::compiler {

/// What can be said of the text without computing anything.
class TextPass {
public:
  TextPass(const Program& program, const Flow& flow, const Target& target, Findings& findings)
      : program_(program), flow_(flow), target_(target), findings_(findings) {}

  void run();

private:
  // ---- the whole text

  void check_bytes();

  void check_bytes_of(std::uint32_t index);

  void add_tab(std::uint32_t index, std::uint32_t first, std::uint32_t end);

  void check_line_ends();

  // ---- line numbers

  void check_numbers();

  void add_empty_line(const Line& line);

  /// Whether some jump names the line; the jumps are sorted once, when this is first asked.
  bool is_target(std::uint32_t number);

  void check_duplicates();

  /// A number between those of the neighbours that no line and no jump has.
  std::optional<std::uint32_t> free_number(std::uint32_t index);

  // ---- statements

  void check_line(const Line& line);

  void check_branch(const StatementNode& statement);

  void check(const StatementNode& statement);

  void check_let(const StatementNode& statement);

  void check_if(const StatementNode& statement);

  void check_for(const ForView& loop);

  void check_on(const StatementNode& statement);

  void check_targets();

  void add_empty_target(const Item& target, std::uint32_t index);

  std::optional<std::uint32_t> number_like(const Item& target) const;
  void add_missing_target(const Item& target);

  void check_print(std::span<const Item> items);

  /// `print 'hello'` prints an empty line, because `'` begins a comment.
  void check_single_quotes(const StatementNode& statement, Span comment);

  void add_semicolon(const Item& semicolon, const Item& next, const std::string& spaced);

  void check_data(std::span<const Item> values);

  void check_read(const StatementNode& statement);

  // ---- blanks

  /// A word stands between two expressions: blanks belong on both of its sides.
  void check_gap(std::uint32_t begin, std::uint32_t end, std::string_view word);

  /// Where a blank should be at `at`, and where one can be put.
  void check_side(std::uint32_t at, std::uint32_t gap, std::string_view word) {
    if (!is_blank(program_.text[at]))
      add_missing_blank(gap, texts::MissingSpaceNextTo(word));
  }

  void add_missing_blank(std::uint32_t at, Message message);

  // ---- expressions

  /// Whether there may be something to say of a node; of most there is nothing.
  bool is_remarkable(const Node& node) const {
    if (node.kind != NodeKind::System)
      return node.kind > NodeKind::Binary || node.overflow;
    return !spec::variables[node.what].old_word.empty();
  }

  void check_node(const Node& node);

  /// Whether the sign of a step stands here, which is documented.
  bool follows_step(std::uint32_t at) const;

  void check_depth(const Node& node);

  void add_negative(const Node& node);

  void check_system(const Node& node);

  /// the operand is the whole expression that follows, which reads otherwise where a weak
  /// operator follows, or anything after a parenthesis.
  void check_operand(const Node& node, const Node& operand);

  /// How many levels a subtree has, and at most can get by fixes: functions and signs count twice.
  /// The operand that an operand of a function begins with, up to the first operator of low level,
  /// or any where `all`.
  const Node& first_operand(const Node& root, bool all) const;
  std::string_view inner_text(const Node& node) const;
  bool is_constant(const Node& root) const;
  bool holds_call(const Node& root) const;

  int deepest_below(const Node& root) const;

  const Program& program_;
  const Flow& flow_;
  const Target& target_;
  Findings& findings_;
  std::vector<std::uint32_t> targets_; ///< line numbers that something names, ascending
  bool targets_sorted_ = false;
  bool blank_missing_ = false;         ///< on this line, and reported
  std::vector<std::uint32_t> offered_; ///< numbers for lines whose own are taken
};

} // namespace orb::compiler
