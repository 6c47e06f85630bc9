#pragma once

#include "base/text/text.h"
#include "compiler/analyse/letters.h"
#include "compiler/analyse/range.h"
#include "compiler/analyse/reading.h"
#include "compiler/lint/lint_passes.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::compiler {

/// By variable, whether it takes all its values: directions, switches and what clients send; a ball
/// is never as fast as its sensors could tell.
inline constexpr auto reaches_ends = [] {
  constexpr std::int32_t byte = 255; // the greatest value of what a client sends
  std::array<bool, spec::variables.size()> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& row = spec::variables[i];
    table[i] = row.unit == "deg" ||
               (row.unit.empty() && row.greatest <= byte && row.variable != spec::Variable::Speed);
  }
  return table;
}();

/// How a letter gets its values, over the whole program.
struct Letter {
  const Item* first_set = nullptr;  ///< null where nothing sets it
  const Node* first_used = nullptr; ///< null where nothing reads it
  bool assigned = false;            ///< by let, read or input
  bool counted = false;             ///< by for
};

/// What is known about the values that `read` takes.
struct DataSet {
  static constexpr std::uint32_t unknown = none;

  std::uint32_t size = unknown;
  std::uint32_t left = unknown;
  const StatementNode* unread = nullptr; ///< the `data` that nothing has read yet
};

/// What is known of a node of an expression.
struct Known {
  Range range;
  bool exact = false; ///< both ends of the range are values that it takes
};

/// What is known of a `for`, over all times that it runs.
struct Loop {
  std::uint32_t code = 0;   ///< a line of code
  std::uint32_t letter = 0; ///< that it counts in
  Range end;
  Range step;
  Range body; ///< what its letter is in the body
};

/// Follows the values of letters along all ways of the program, then goes through its lines in the
/// order of the text and says what is wrong with the values that expressions have there.
class ValuesPass {
public:
  ValuesPass(const Program& program, const Flow& flow, const Target& target, Findings& findings)
      : program_(program), flow_(flow), target_(target), findings_(findings),
        known_(program.nodes.size()), ways_(program, flow) {}

  /// Carries values through straight runs of lines only, and forgets them where a jump comes in.
  void run();

  /// Whether following all ways could say more: something that is not known here is set, somewhere,
  /// to what is not allowed here.
  bool may_say_more();

  /// The same with all ways followed.
  void run_followed();

private:
  /// An expression that nothing is said about, as its letters are not known.
  struct Doubt {
    std::uint32_t root;
    std::int64_t least; ///< what is allowed
    std::int64_t greatest;
  };

  /// A letter that is not known here, compared by `=`.
  struct Question {
    std::uint32_t letter;
    std::int32_t number;
  };

  void doubt(const Item& value, std::int64_t least, std::int64_t greatest);

  /// Notes what a letter is set to, where that is known by itself.
  void note_given(std::uint32_t letter, Range range, const Node* root);

  /// Whether a value is a sum wrapped around by `%`, which is never negative where its parts are
  /// not.
  bool is_wrapped(const Node& root) const;

  // ---- letters

  void collect_letters();

  void collect_set(const StatementNode& statement);

  /// Whether some `let` of the letter clears a sensor by reading it, which then is the purpose.
  bool clears(std::uint32_t letter) const;

  bool reads_clearing(const Item& expression) const;

  void check_letters();
  std::string meant_by(std::uint32_t letter) const;

  /// Forgets what letters are.
  void forget_letters();

  void set_letter(std::uint32_t index, Range range) { set_letter(index, range, 0, 0); }
  /// `exact` and `dense`: 1 or 0.
  void set_letter(std::uint32_t index, Range range, LetterSet exact, LetterSet dense);

  // ---- ways

  void follow();

  void follow(std::uint32_t begin);

  /// The values that `read` can take.
  void find_data();

  /// Runs a statement of a line on what is known, and looks for mistakes in it unless the ways are
  /// still being followed; whether the line below can be next.
  bool go(const StatementNode& statement, std::uint32_t code);

  bool go_branches(const StatementNode& statement, std::uint32_t code);

  bool go_branch(const IfView& condition, Holds holds, const StatementNode* branch,
                 std::uint32_t code);

  /// Narrows the letters of a condition to where it holds or not; false where that cannot be.
  bool assume(const IfView& condition, Holds holds);

  bool assume(const Comparison& comparison, Holds holds);

  void narrow(const Item& side, const Range& from, const Range& to);

  void set(const LetView& let);

  /// All that the letter of a loop is in its body, where nothing else sets it.
  Range rounds(const ForView& loop, const Range& start, const Range& end, const Range& step) const;

  void begin_loop(const ForView& loop, std::uint32_t code);

  /// `next` leads back to the line below each `for` of its letter that can be open.
  bool end_loop(const NextView& next);

  bool followed_or_following() const { return following_ || followed_; }

  /// Goes back to the body of a loop; what its letter is where the loop is over, if it can be.
  std::optional<Range> next_of(const Loop& loop, const Letters& before);

  void read(std::span<const Item> variables);

  bool jump(const StatementNode& statement, std::uint32_t code);

  // ---- lines

  /// Forgets what was noted on the way: the line can be reached from elsewhere.
  void begin_block();

  void check_lines();

  /// Takes up what is known of the letters at a line, once all ways have been followed.
  void take_up(std::uint32_t code);

  const Range& range_of(const Item& expression) const { return known_[expression.value].range; }

  void check_range(const Item& value, std::string_view word, const spec::Parameter& parameter) {
    const auto& range = range_of(value);
    if (range.lo < parameter.least || parameter.greatest < range.hi)
      check_outside(value, word, parameter);
  }
  void check_outside(const Item& value, std::string_view word, const spec::Parameter& parameter);

  /// What an expression of numbers and a sensor is often enough, in any program that drives, where
  /// that is known of the sensor. A program that compares it may know what it does.
  std::optional<Range> usual_range(const Item& value) const;
  std::optional<Range> usual_values(const spec::VariableInfo& row) const;
  bool is_compared(spec::Variable variable) const;

  void check_may_leave(const Item& value, std::string_view word, const spec::Parameter& parameter);

  void add_may_leave(const Item& value, Message allowed, Message help);
  void add_can_be(const Item& value, Message allowed, std::int32_t number);

  void add_out_of_range(const Item& value, std::string_view word, const spec::Parameter& parameter);

  /// A loop that nothing leaves early reaches both ends of its range, and so does what is computed
  /// from its letter by `+`, `-` and `*` alone: whether a value is that.
  bool is_counted(const Item& value) const;
  /// Whether it said that a loop leaves the range of a parameter.
  bool check_loop_range(const Item& value, std::string_view word, const spec::Parameter& parameter);

  static bool keeps_ends(const Node& node);

  void check_arguments(const StatementNode& statement);

  std::string_view comma_of(std::span<const Item> arguments) const;
  bool check_swapped(std::span<const Item> arguments);
  bool check_backward(const StatementNode& statement);
  void add_missing_go(const StatementNode& statement, const Item& last);

  void check_flags(const Item& value);

  /// The line that runs after waking lies in flash; that is this program only when it is meant for
  /// flash.
  void check_sleep(const Item& value);

  void check_let(const LetView& let);

  void check_for(const ForView& loop);

  /// A variable gets a value that is not known.
  void forget(std::span<const Item> variables);

  void check_indexed(std::span<const Item> variables);

  void check_index(Span span);

  void count_from_one(Span use, Diagnostic& d) const;
  void check_on(const OnView& on);

  void check_condition(const IfView& condition);

  /// A letter that holds what a sensor or `rnd` gave, compared with what that never is. Sensors
  /// themselves are compared elsewhere.
  void check_answer(const Comparison& comparison);

  void check_print(const StatementNode& statement);

  void check_input(const StatementNode& statement);

  void check_data(const StatementNode& statement);

  void check_read(const StatementNode& statement);

  bool has_data();

  // ---- expressions

  /// Computes nodes, and looks for mistakes in them unless the ways are still being followed.
  void compute(std::uint32_t begin, std::uint32_t end);

  /// The range of an expression, computed now.
  const Range& compute(const Item& item) {
    compute(program_.nodes[item.value].first, item.value + 1);
    return range_of(item);
  }

  void compute_operation(const Node& node, std::uint32_t index);

  void know(std::uint32_t index, Range range, bool exact) { known_[index] = {range, exact}; }

  bool is_exact(std::uint32_t letter) const { return (now_.exact & bit(letter)) != 0; }

  bool is_exact_sum(const Node& node, std::uint32_t right) const;

  void note_use(const Node& letter) {
    auto& first = letters_[letter.what].first_used;
    first = first == nullptr ? &letter : first;
  }

  /// Of a statement that cannot run: it still uses what it names.
  void note_uses(const StatementNode& statement);

  void note_clearing(const Node& node, const spec::VariableInfo& row);

  void check_binary(const Node& node, std::uint32_t index);

  void check_quotient(const Node& node, std::uint32_t index);

  void check_call(const Node& node, std::uint32_t index);

  const Program& program_;
  const Flow& flow_;
  const Target& target_;
  Findings& findings_;
  std::array<Letter, most_letters> letters_{};
  std::vector<Known> known_; ///< by node

  // what is known on the way
  Letters now_;
  LetterSet set_ = 0; ///< letters that something sets
  Letters unknown_;   ///< where nothing is known but that letters are 0 which nothing sets
  LetterFlow ways_;
  std::vector<Loop> loops_; ///< that have been entered
  std::vector<Doubt> doubts_;
  std::vector<Question> questions_;
  bool index_doubt_ = false; ///< `Z` is used while `Y` is not known
  std::array<std::optional<Range>, most_letters>
      given_{};             ///< what is known by itself, over all lines
  Range data_range_;        ///< of the values of all `data`
  std::uint32_t block_ = 0; ///< the line from which `now_` is followed
  LetterSet tested_ = 0;    ///< letters that the condition of this line narrows
  LetterSet moved_ = 0;     ///< letters that became something else in a branch of this line
  bool following_ = false;
  bool followed_ = false;
  std::optional<std::int32_t> index_begins_; ///< where the loop around counts in `Y`: from there

  DataSet data_;
  LetterSet cleared_ = 0;         ///< variables that are 0 because they have been read
  LetterSet cleared_on_line_ = 0; ///< the same, by this line
  LetterSet counting_ = 0;        ///< letters of loops that reach their ends for certain
  std::uint32_t line_ = 0;        ///< that is looked at
  bool conditional_ = false;      ///< in a branch

  bool indexed_used_ = false;
  bool in_order_ = true; ///< nothing above leads away and back, or past lines
  bool before_y_ = false;
  std::optional<bool> has_data_;
};

} // namespace orb::compiler
