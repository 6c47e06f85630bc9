#pragma once

#include "compiler/analyse/range.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/lint/sums.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"
#include "structured/meaning/check.h"
#include "structured/text/blocks.h"
#include "structured/text/rules.h"
#include "structured/text/texts.h"
#include "structured/text/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace orb::structured {

class Checker {
public:
  Checker(Program& program, const Names& names, const compiler::Target& target)
      : program_(program), names_(names), target_(target) {}

  void run();

private:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {});
  Diagnostic& report(const Rule& rule, Span span, compiler::Said said) {
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

  /// The `and` or `or` of two numbers.
  std::optional<Span> word_between_numbers(std::uint32_t node) const;

  /// The statement as an `if` of one line that puts 1 or 0 where a condition is a number; nothing
  /// where it shares its line or asks for more.
  std::optional<std::string> with_if(const Statement& statement, std::uint32_t node) const;

  /// Whether a name in an expression is unknown, which has been reported.
  bool names_unknown(std::uint32_t root) const;

  /// A sum or product of constants beyond what a number can be.
  void check_overflow(std::uint32_t n);

  /// Whether `&` or `|` stands between conditions.
  bool joins_conditions(std::uint32_t n) const;
  void report_bitwise(std::uint32_t n);

  void check_node(const Statement& statement, std::uint32_t n, bool is_root);

  /// A sensor that is compared with a number, whichever side it stands on.
  void check_sensor(std::uint32_t n);

  static Comparison mirrored(Comparison comparison);

  /// The same question as the robot asks it, which has no `<=` and `>=`.
  static std::optional<compiler::SensorQuestion>
  question_of(Comparison comparison, spec::Variable sensor, std::int32_t number);

  /// `1 / 2` is 0.
  void check_quotient(std::uint32_t n);

  /// `x = 1 or 6`: the number was meant to be compared like the one before it.
  void check_sides(std::uint32_t root);

  void check_side(std::uint32_t side, std::uint32_t other);

  /// 2147483648 can only be written with a minus sign before it.
  void check_number(std::uint32_t n, bool is_root);

  void check_index(std::uint32_t n);

  void check_version(Span span, std::string_view word, spec::BasicVersion since, bool old_name);

  // ---- where statements stand

  /// Keeps the open blocks; the end of a block has its opener's depth.
  void follow(std::uint32_t i, const Statement& statement);

  bool in_loop() const;

  bool in_select() const;

  /// Whether the line that begins the sub around a statement does not parse.
  bool in_broken_routine() const;

  void misplaced(const Statement& statement, Message message, Message help = {});

  /// Of what nothing is around to be left, also where the words are those of another language,
  /// which is not a second mistake.
  void stands_outside(const Statement& statement, const Row<Hole::Code>& outside,
                      Message help = {});

  void check_place(std::uint32_t i, const Statement& statement);

  /// The first part of the innermost block where it lies after statement `i`.
  std::uint32_t none_yet(std::uint32_t i) const;

  void check_return(std::uint32_t routine, const Statement& statement);

  // ---- statements

  void check_statement(const Statement& statement);

  void check_assign(const Statement& statement);

  /// Offers the other heading where a speed is below 0, to the finding about that.
  void check_swapped(const Statement& statement);
  void help_backwards(const Statement& statement, Diagnostic& d);
  /// The finding, where there is one; until the next.
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

  /// A loop of which nothing is ever done: its numbers lie the other way round.
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

  /// Whether every block around `label` is also around `other`.
  bool encloses(std::uint32_t label, std::uint32_t other) const;

  void check_recursion();

  void report_cycle(const std::vector<std::pair<std::uint32_t, std::size_t>>& path,
                    std::uint32_t callee);

  // ---- loops

  void check_loops();

  /// Whether a condition of constants holds.
  bool always_holds(std::uint32_t condition) const;

  /// A loop that waits while what holds for one reading holds.
  void check_inverted(std::uint32_t i);

  /// What stands after a loop that nothing leaves.
  void check_endless(std::uint32_t i);

  /// What stands after a statement that does not go on: `end`, `sleep`, `goto`, `return`, `exit`.
  void check_left(std::uint32_t i);

  /// The statement `after`, where nothing leads there because nothing gets past `i`; null where
  /// something else does, or where it would do nothing.
  const Statement* never_reached(std::uint32_t i, std::uint32_t after) const;

  /// A loop whose counter is an index in each turn, and not always that of an element.
  void check_counter(std::uint32_t i);

  /// A loop that calls what counts with its variable, too.
  void check_called_loops();

  // ---- sums

  /// A comparison with a number; nothing of any other node.
  std::optional<compiler::Bound> bound_of(std::uint32_t relation) const;

  /// `x > 9 and x < 1` never holds, `x <> 1 or x <> 2` always.
  void check_joint(std::uint32_t n);

  /// A loop that ends with an `exit` that asks nothing.
  void check_single_round(std::uint32_t i);

  // ---- what is hardly meant

  /// A change of a parameter, which the caller never sees.
  void check_parameters();
  bool is_read_after(std::uint32_t statement, std::uint32_t symbol) const;

  /// Lines that look as if they belonged to the `if` of one line above them.
  void check_indented();

  // ---- functions without a value

  void check_values();

  // ---- unused names

  std::ptrdiff_t line_of(Span span) const;

  void check_unused();

  void check_uncalled(const Symbol& symbol);

  void report_unused(const Symbol& symbol, const Row<Hole::Code>& unused);

  bool in_main_file(Span span) const;

  /// Not only declarations, for others to include.
  bool main_file_runs() const;

  std::string_view name_of(std::uint32_t routine) const;

  compiler::Timers timers_;
  Program& program_;
  const Names& names_;
  const compiler::Target& target_;
  std::vector<std::uint32_t> open_;
  std::vector<CaseRange> cases_;
  std::pair<std::int32_t, std::int32_t> crossed_{-1, -1}; ///< the names of a `for` and its `next`
};

} // namespace orb::structured
