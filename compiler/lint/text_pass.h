#pragma once

#include "compiler/lint/lint_passes.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/text/basic_words.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace orb::compiler {

/// Lints the text without evaluating it. Large because each rule about the text has its own member.
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

  /// True if a jump names the line. The first call sorts the jumps.
  bool is_target(std::uint32_t number);

  void check_duplicates();

  /// A number between those of the neighbours that no line or jump uses.
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

  // ---- spaces

  /// Checks for spaces on both sides of a word between two expressions.
  void check_gap(std::uint32_t begin, std::uint32_t end, std::string_view word);

  /// Checks for a space at `at`; the fix inserts it at `gap`.
  void check_side(std::uint32_t at, std::uint32_t gap, std::string_view word) {
    if (!is_blank(program_.text[at]))
      add_missing_blank(gap, texts::MissingSpaceNextTo(word));
  }

  void add_missing_blank(std::uint32_t at, Message message);

  // ---- expressions

  /// True if a node may have a finding; most cannot.
  bool is_remarkable(const Node& node) const {
    if (node.kind != NodeKind::System)
      return node.kind > NodeKind::Binary || node.overflow;
    return !spec::variables[node.what].old_word.empty();
  }

  void check_node(const Node& node);

  /// True if the sign after `step` is here: it is documented.
  bool follows_step(std::uint32_t at) const;

  void check_depth(const Node& node);

  void add_negative(const Node& node);

  void check_system(const Node& node);

  /// the operand is the whole expression that follows. That surprises if a weak operator
  /// follows, or anything after a parenthesis.
  void check_operand(const Node& node, const Node& operand);

  /// The first operand within the operand of a function, up to the first operator of low level, or
  /// of any level if `all`.
  const Node& first_operand(const Node& root, bool all) const;
  std::string_view inner_text(const Node& node) const;
  bool is_constant(const Node& root) const;
  bool holds_call(const Node& root) const;

  /// The greatest depth of a subtree after fixes: functions and signs count twice.
  int deepest_below(const Node& root) const;

  const Program& program_;
  const Flow& flow_;
  const Target& target_;
  Findings& findings_;
  std::vector<std::uint32_t> targets_; ///< line numbers named by jumps, ascending
  bool targets_sorted_ = false;
  bool blank_missing_ = false;         ///< a missing space was reported on this line
  std::vector<std::uint32_t> offered_; ///< numbers offered for lines with duplicate numbers
};

} // namespace orb::compiler
