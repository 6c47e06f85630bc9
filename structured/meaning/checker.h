#pragma once

#include "compiler/analyse/range.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/lint/sums.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"
#include "structured/meaning/check.h"
#include "structured/text/link_blocks.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace orb::structured {

/// Checks a program whose names are resolved. Large because each rule has its own member, and all
/// of them report on the same program and names.
class Checker {
public:
  Checker(Program& program, const Names& names, const compiler::Target& target)
      : program_(program), names_(names), target_(target) {}

  void run();

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {});
  Diagnostic& report(const Rule& rule, Span span, compiler::FindingTexts said) {
    return report(rule, span, std::move(said.message), std::move(said.help));
  }
  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& statement, std::uint32_t n) const;
  static std::uint32_t size(const Statement& statement);
  std::optional<Constant> value_of(const Item& part) const;

  void note_timer(const Statement& statement);

  // ---- expressions

  void check_expressions(const Statement& statement);

  void report_condition(const Statement& statement, std::uint32_t node);

  /// The `and` or `or` between two numbers.
  std::optional<Span> word_between_numbers(std::uint32_t node) const;

  /// Rewrites the statement as a one-line `if` that sets 1 or 0 where a condition is used as a
  /// number; nothing if it shares its line or needs more.
  std::optional<std::string> with_if(const Statement& statement, std::uint32_t node) const;

  /// True if a name in an expression is unknown, which is already reported.
  bool names_unknown(std::uint32_t root) const;

  /// Reports a sum or product of constants that exceeds the number range.
  void check_overflow(std::uint32_t n);

  /// True if `&` or `|` joins conditions.
  bool joins_conditions(std::uint32_t n) const;
  void report_bitwise(std::uint32_t n);

  void check_node(const Statement& statement, std::uint32_t n, bool is_root);

  /// Checks a sensor compared with a number, on either side.
  void check_sensor(std::uint32_t n);

  /// Reports `1 / 2`, which is 0.
  void check_quotient(std::uint32_t n);

  /// Reports `x = 1 or 6`: the second number was meant to be compared, too.
  void check_sides(std::uint32_t root);

  void check_side(std::uint32_t side, std::uint32_t other);

  /// Reports 2147483648 without a minus sign before it.
  void check_number(std::uint32_t n, bool is_root);

  void check_index(std::uint32_t n);

  void check_version(Span span, std::string_view word, spec::BasicVersion since);

  // ---- placement of statements

  /// Tracks the open blocks; the end of a block has its opener's depth.
  void follow(std::uint32_t i, const Statement& statement);

  bool in_loop() const;

  bool in_select() const;

  /// True if the first line of the enclosing sub does not parse.
  bool in_broken_routine() const;

  void misplaced(const Statement& statement, Message message, Message help = {});

  /// Reports a statement outside the block that it leaves. Foreign words are not reported again.
  void stands_outside(const Statement& statement, const Row<Hole::Code>& outside,
                      Message help = {});

  void check_place(std::uint32_t i, const Statement& statement);

  /// The first part of the innermost block if it comes after statement `i`.
  std::uint32_t none_yet(std::uint32_t i) const;

  void check_return(std::uint32_t routine, const Statement& statement);

  // ---- statements

  void check_statement(const Statement& statement);

  void check_assign(const Statement& statement);

  /// Adds the opposite heading as an offer to the finding about a negative speed.
  void check_swapped(const Statement& statement);
  void help_backwards(const Statement& statement, Diagnostic& d);
  /// Returns the finding, if any; valid until the next one.
  Diagnostic* check_range(const Item& part, std::string_view word,
                          const spec::Parameter& parameter);

  void check_robot(const Statement& statement);

  void check_colour(const Statement& statement);

  void check_data(const Statement& statement);

  bool require_constant(const Item& part);

  bool is_quotient(std::uint32_t node) const;

  void check_sleep(const Statement& statement);

  // ---- loops

  std::uint32_t variable_of(const Statement& loop) const;

  void check_for(const Statement& statement);

  /// Reports a loop that never runs because its bounds are reversed.
  void check_direction(const Statement& statement);
  void check_next(const Statement& statement);

  // ---- select

  void check_case(const Statement& statement);

  struct CaseRange {
    std::int32_t lo;
    std::int32_t hi;
    std::uint32_t select;
  };

  void add_case(CaseRange range, Span span);

  // ---- jumps and calls

  void check_jumps();

  void check_goto(std::uint32_t i, const std::vector<std::uint32_t>& labels);
  void check_label(std::uint32_t label);

  void report_unknown_label(std::uint32_t i, const std::vector<std::uint32_t>& labels);

  /// True if every block around `label` is also around `other`.
  bool encloses(std::uint32_t label, std::uint32_t other) const;

  void check_recursion();

  void report_cycle(const std::vector<std::pair<std::uint32_t, std::size_t>>& path,
                    std::uint32_t callee);

  // ---- loops

  void check_loops();

  /// True if a condition of constants holds.
  bool always_holds(std::uint32_t condition) const;

  /// Reports a loop that waits while a momentary condition holds.
  void check_inverted(std::uint32_t i);

  /// Reports code after a loop without an exit.
  void check_endless(std::uint32_t i);

  /// Reports code after a statement that does not fall through: `end`, `sleep`, `goto`, `return`,
  /// `exit`.
  void check_left(std::uint32_t i);

  /// The statement `after`, if it is unreachable because control never passes `i`; null if it is
  /// reachable or has no effect.
  const Statement* never_reached(std::uint32_t i, std::uint32_t after) const;

  /// Reports a loop whose counter is an index that goes out of bounds.
  void check_counter(std::uint32_t i);

  /// Reports a loop that calls a routine with the same counter.
  void check_called_loops();

  // ---- sums

  /// Reads a comparison with a number; nothing for any other node.
  std::optional<compiler::Bound> bound_of(std::uint32_t relation) const;

  /// Reports `x > 9 and x < 1`, which never holds, and `x <> 1 or x <> 2`, which always holds.
  void check_joint(std::uint32_t n);

  /// Reports a loop that ends with an unconditional `exit`.
  void check_single_round(std::uint32_t i);

  // ---- unlikely intent

  /// Reports an assignment to a parameter, which the caller never sees.
  void check_parameters();
  bool is_read_after(std::uint32_t statement, std::uint32_t symbol) const;

  /// Reports lines that are indented as if they belonged to the one-line `if` above.
  void check_indented();

  // ---- functions without a value

  void check_values();

  // ---- unused names

  std::ptrdiff_t line_of(Span span) const;

  void check_unused();

  void check_uncalled(const Symbol& symbol);

  void report_unused(const Symbol& symbol, const Row<Hole::Code>& unused);

  bool in_main_file(Span span) const;

  /// True if the main file has more than declarations for others to include.
  bool main_file_runs() const;

  std::string_view name_of(std::uint32_t routine) const;

  compiler::Timers timers_;
  Program& program_;
  const Names& names_;
  const compiler::Target& target_;
  std::vector<std::uint32_t> open_;
  std::vector<CaseRange> cases_;
  std::pair<std::int32_t, std::int32_t> crossed_{-1, -1}; ///< the names in a crossed pair
};

} // namespace orb::structured
