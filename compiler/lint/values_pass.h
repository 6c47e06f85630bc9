#pragma once

#include "base/text/text.h"
#include "compiler/analyse/letter_flow.h"
#include "compiler/analyse/range.h"
#include "compiler/analyse/reading.h"
#include "compiler/lint/lint_passes.h"
#include "compiler/lint/usual_values.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::compiler {

/// By variable: true if all its values occur, as for directions, switches and values from clients.
/// A ball never reaches the limits of its other sensors.
inline constexpr auto reaches_ends = [] {
  constexpr std::int32_t byte = 255; // the greatest value that a client sends
  std::array<bool, spec::variables.size()> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& row = spec::variables[i];
    table[i] = row.unit == "deg" ||
               (row.unit.empty() && row.greatest <= byte && row.variable != spec::Variable::Speed);
  }
  return table;
}();

/// The uses of a letter in the whole program.
struct Letter {
  const Item* first_set = nullptr;  ///< null if it is never assigned
  const Node* first_used = nullptr; ///< null if it is never read
  bool assigned = false;            ///< by let, read or input
  bool counted = false;             ///< by for
};

/// The state of the data that `read` consumes.
struct DataSet {
  static constexpr std::uint32_t unknown = none;

  std::uint32_t size = unknown;
  std::uint32_t left = unknown;
  const StatementNode* unread = nullptr; ///< the first `data` not read yet
};

/// The state of a `for`, over all its executions.
struct Loop {
  std::uint32_t code = 0;   ///< a line of code
  std::uint32_t letter = 0; ///< its counter
  Range end;
  Range step;
  Range body; ///< the range of its letter in the body
};

/// Propagates the values of letters along all paths, then walks the lines in text order and reports
/// bad values. Given the usual values of sensors, takes those for all that occur; then only
/// MayLeaveRange counts. Large because each check of a value has its own member, and all of them
/// need the state of the letters at the current line.
class ValuesPass {
public:
  ValuesPass(const Program& program, const Flow& flow, const Target& target,
             const UsualValues* usual, Findings& findings)
      : program_(program), flow_(flow), target_(target), usual_(usual), findings_(findings),
        known_(program.nodes.size()), ways_(program, flow) {}

  /// If jumps are unknown, follows values only up to the next line that a jump may reach. Returns
  /// true if some value may stop the program.
  bool run(Jumps jumps);

private:
  // ---- letters

  void collect_letters();
  /// Gives a letter that the program does not use to each sensor that it compares at least twice,
  /// for what a test tells of the next one.
  void find_sensors();
  Value known_of_sensor(std::size_t index) const;
  LetterValues at_start() const;
  /// Forgets what tests have told of sensors: time has passed.
  void forget_sensors();

  void collect_set(const StatementNode& statement);

  /// True if some `let` of the letter only serves to clear a sensor by reading it.
  bool clears(std::uint32_t letter) const;

  bool reads_clearing(const Item& expression) const;

  void check_letters();
  std::string meant_by(std::uint32_t letter) const;

  /// Forgets the values of all letters.
  void forget_letters();

  void set_letter(std::uint32_t index, const Value& value);

  // ---- paths

  void follow();

  void follow(std::uint32_t begin);

  /// Finds the values that `read` can return.
  void find_data();

  /// Executes a statement of a line on the current state; reports mistakes once the fixed point is
  /// reached. Returns true if the line below can follow.
  bool go(const StatementNode& statement, std::uint32_t code);

  bool go_branches(const StatementNode& statement, std::uint32_t code);

  bool go_branch(const IfView& condition, Holds holds, const StatementNode* branch,
                 std::uint32_t code);

  /// Narrows the letters of a condition to where it holds or not; returns false if that is
  /// impossible.
  bool assume(const IfView& condition, Holds holds);

  bool assume(const Comparison& comparison, Holds holds);

  void narrow(const Item& side, const Range& from, const Range& to);

  void set(const LetView& let);

  /// The range of a loop's letter in its body, if nothing else assigns it.
  Range rounds(const ForView& loop, const Range& start, const Range& end, const Range& step) const;

  void begin_loop(const ForView& loop, std::uint32_t code);

  /// Leads `next` back to the line below each `for` of its letter that can be open.
  bool end_loop(const NextView& next, std::uint32_t code);
  /// The line of the nearest `for` of a letter above a line; none if all are below.
  std::uint32_t loop_above(std::uint32_t letter, std::uint32_t code) const;

  bool followed_or_following() const { return following_ || followed_; }

  /// Returns to the body of a loop; gives the range of its letter after the loop, if it can end.
  std::optional<Range> next_of(const Loop& loop, const LetterValues& before);

  void read(std::span<const Item> variables);

  bool jump(const StatementNode& statement, std::uint32_t code);

  // ---- lines

  /// Forgets the notes on the current run of lines: this line can be reached from elsewhere.
  void begin_block();

  void check_lines();

  /// Loads the state of the letters at a line, once all paths have been followed.
  void take_up(std::uint32_t code);

  const Range& range_of(const Item& expression) const { return known_[expression.value].range; }

  void check_range(const Item& value, std::string_view word, const spec::Parameter& parameter) {
    const auto& range = range_of(value);
    if (range.lo < parameter.least || parameter.greatest < range.hi)
      check_outside(value, word, parameter);
  }
  void check_outside(const Item& value, std::string_view word, const spec::Parameter& parameter);

  /// Reports a bad value that sensors usually cause: one above the allowed values, or below if it
  /// is no time, which a program may know to be short.
  void check_usual(const Value& value, Span span, std::int64_t least, std::int64_t greatest,
                   Message allowed);

  void check_may_leave(const Item& value, std::string_view word, const spec::Parameter& parameter);

  void add_may_leave(const Item& value, Message allowed, Message help);

  void add_out_of_range(const Item& value, std::string_view word, const spec::Parameter& parameter);

  /// True if a value is computed by `+`, `-` and `*` alone from the letter of a loop without an
  /// early exit. Such a loop reaches both ends of its range, and so does the value.
  bool is_counted(const Item& value) const;
  /// Reports a loop that leaves the range of a parameter; returns true if it did.
  bool check_loop_range(const Item& value, std::string_view word, const spec::Parameter& parameter);

  static bool keeps_ends(const Node& node);

  void check_arguments(const StatementNode& statement);

  std::string_view comma_of(std::span<const Item> arguments) const;
  bool check_swapped(std::span<const Item> arguments);
  bool check_backward(const StatementNode& statement);
  void add_missing_go(const StatementNode& statement, const Item& last);

  void check_flags(const Item& value);

  /// The line to run after waking is in flash; that is this program only if it is written for
  /// flash.
  void check_sleep(const Item& value);

  void check_let(const LetView& let);

  void check_for(const ForView& loop);

  /// Marks the variables as unknown.
  void forget(std::span<const Item> variables);

  void check_indexed(std::span<const Item> variables);

  void check_index(Span span);

  void count_from_one(Span use, Diagnostic& d) const;
  void check_on(const OnView& on);

  void check_condition(const IfView& condition);

  /// A letter with the result of a sensor or `rnd`, compared with a value that it never has.
  /// Sensors themselves are checked elsewhere.
  void check_answer(const Comparison& comparison);
  void check_known_bound(const Comparison& comparison);
  std::optional<Orders> written_orders(const Comparison& comparison) const;

  void check_print(const StatementNode& statement);

  void check_input(const StatementNode& statement);

  void check_data(const StatementNode& statement);

  void check_read(const StatementNode& statement);

  bool has_data();

  // ---- expressions

  /// Computes nodes; reports mistakes once the fixed point is reached.
  void compute(std::uint32_t begin, std::uint32_t end);

  /// Recomputes the range of an expression.
  const Range& compute(const Item& item) {
    compute(program_.nodes[item.value].first, item.value + 1);
    return range_of(item);
  }

  /// Reports the mistakes of a node that has just been computed.
  void check_node(const Node& node, std::uint32_t index);

  /// Notes that an expression can have a value that stops the program. One of numbers and sensors
  /// alone does not count: a trial knows no more of it.
  void note_risk(std::uint32_t root);

  void note_use(const Node& letter) {
    auto& first = letters_[letter.what].first_used;
    first = first == nullptr ? &letter : first;
  }

  /// Records the uses in a statement that cannot run.
  void note_uses(const StatementNode& statement);

  void note_clearing(const Node& node, const spec::VariableInfo& row);

  void check_binary(const Node& node, std::uint32_t index);

  void check_quotient(const Node& node, std::uint32_t index);

  void check_call(const Node& node, std::uint32_t index);

  const Program& program_;
  const Flow& flow_;
  const Target& target_;
  const UsualValues* usual_; ///< null: any value that a sensor can have
  Findings& findings_;
  std::array<Letter, most_letters> letters_{};
  std::vector<Value> known_; ///< by node

  // the current state
  LetterValues now_;
  LetterSet set_ = 0; ///< letters with an assignment
  std::array<std::uint8_t, spec::variables.size()> letter_of_sensor_{}; ///< 0: none
  std::uint32_t first_sensor_ = 0;  ///< their letters: the first
  std::uint32_t after_sensors_ = 0; ///< the one after the last
  LetterValues unknown_; ///< the unknown state, except that letters without an assignment are 0
  LetterFlow ways_;
  std::vector<Loop> loops_; ///< loops entered so far
  Range data_range_;        ///< of all `data` values
  std::uint32_t block_ = 0; ///< the line where the current run of lines began
  LetterSet tested_ = 0;    ///< letters narrowed by the condition of this line
  bool following_ = false;
  bool followed_ = false;
  bool at_risk_ = false;                     ///< a trial may find more
  std::optional<std::int32_t> index_begins_; ///< start of the enclosing loop if it counts in `Y`

  DataSet data_;
  LetterSet cleared_ = 0;         ///< variables that are 0 because they were read
  LetterSet cleared_above_ = 0;   ///< the same, on all paths to this line
  LetterSet cleared_on_line_ = 0; ///< the same, on this line
  LetterSet counting_ = 0;        ///< letters of loops that certainly reach their ends
  std::uint32_t code_ = 0;        ///< the current line of code
  std::uint32_t line_ = 0;        ///< the current line
  bool conditional_ = false;      ///< in a branch

  bool indexed_used_ = false;
  bool in_order_ = true; ///< no jump above leads away and back, or past lines
  bool before_y_ = false;
  std::optional<bool> has_data_;
};

} // namespace orb::compiler
