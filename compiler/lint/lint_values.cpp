#include "base/text.h"
#include "compiler/lint/lint_passes.h"

#include "compiler/lint/range.h"
#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::letter_name;

constexpr auto letters = spec::letter_count;
constexpr std::uint32_t index_letter = letters - 1; // Y
constexpr std::int32_t full_turn =
    spec::info(spec::Statement::Goroll).parameters()[0].greatest + 1; // degrees

constexpr std::uint32_t bit(std::uint32_t n) {
  return std::uint32_t{1} << n;
}

std::string shown(Range range) {
  return range.constant() ? fmt::format("{}", range.lo)
                          : fmt::format("{} to {}", range.lo, range.hi);
}

/// How a letter gets its values, over the whole program.
struct Letter {
  const Item* first_set = nullptr;  ///< null where nothing sets it
  const Node* first_used = nullptr; ///< null where nothing reads it
  bool assigned = false;            ///< by let, read or input
  bool counted = false;             ///< by for
};

/// What is known about A to Y on the way through a straight run of lines.
class KnownLetters {
public:
  /// Forgets all values.
  void begin_block() { ++block_; }
  bool knows(std::uint32_t letter) const { return stamps_[letter] == block_; }
  Range operator[](std::uint32_t letter) const { return values_[letter]; }
  void set(std::uint32_t letter, Range range) {
    values_[letter] = range;
    stamps_[letter] = block_;
  }

private:
  std::array<Range, letters> values_{};
  std::array<std::uint32_t, letters> stamps_{};
  std::uint32_t block_ = 0;
};

/// What is known about the values that `read` takes.
struct DataSet {
  static constexpr std::uint32_t unknown = none;

  std::uint32_t size = unknown;
  std::uint32_t left = unknown;
  const StatementNode* unread = nullptr; ///< the `data` that nothing has read yet
};

/// Goes through the lines in the order of the text and computes the range of every expression.
/// Ranges are carried through straight runs of lines and forgotten where a jump comes in.
class ValuesPass {
public:
  ValuesPass(const Program& program, const Flow& flow, const Target& target, Findings& findings)
      : program_(program), flow_(flow), target_(target), findings_(findings),
        ranges_(program.nodes.size()) {}

  void run() {
    collect_letters();
    check_lines();
    check_letters();
  }

private:
  // ---- letters

  void collect_letters() {
    for (const auto& statement : program_.statements)
      collect_set(statement);
  }

  void collect_set(const StatementNode& statement) {
    auto items = program_.items_of(statement);
    if (statement.error || items.empty() || statement.kind == spec::Statement::Next)
      return;
    if (statement.kind != spec::Statement::Read) // all others set one variable, which comes first
      items = items.first(1);
    for (const auto& item : items) {
      if (item.kind != ItemKind::Letter)
        continue;
      auto& letter = letters_[item.value];
      if (letter.first_set == nullptr)
        letter.first_set = &item;
      (statement.kind == spec::Statement::For ? letter.counted : letter.assigned) = true;
    }
  }

  /// Whether some `let` of the letter clears a sensor by reading it, which then is the purpose.
  bool clears(std::uint32_t letter) const {
    return std::any_of(program_.statements.begin(), program_.statements.end(),
                       [&](const auto& statement) {
                         if (statement.error || statement.kind != spec::Statement::Let)
                           return false;
                         const auto let = program_.as<LetView>(statement);
                         return let.variable.kind == ItemKind::Letter &&
                                let.variable.value == letter && reads_clearing(let.expression);
                       });
  }

  bool reads_clearing(const Item& expression) const {
    for (auto n = program_.nodes[expression.value].first; n <= expression.value; ++n)
      if (program_.nodes[n].kind == NodeKind::System &&
          spec::variables[program_.nodes[n].what].access == spec::Access::ReadClears)
        return true;
    return false;
  }

  void check_letters() {
    const bool silent = !program_.faults.empty(); // a line that does not parse may hold the rest
    for (std::uint32_t i = 0; i < letters && !silent; ++i) {
      const auto& letter = letters_[i];
      const bool used = letter.first_used != nullptr;
      const bool set = letter.first_set != nullptr;
      if (set && !used && !letter.counted && !(i == index_letter && indexed_used_) && !clears(i)) {
        findings_.add(rules::UnusedVariable, letter.first_set->span,
                      fmt::format("`{}` is set but never used", letter_name(i)));
      } else if (used && !set) {
        findings_.add(rules::NeverAssigned, letter.first_used->span,
                      fmt::format("`{}` is used but never set, so it is 0", letter_name(i)));
      }
    }
  }

  /// What is known about a letter at the start of a block, and until it is set within it.
  Range unknown_letter(std::uint32_t index) const {
    return letters_[index].first_set == nullptr ? Range::only(0) : Range{};
  }

  Range value_of_letter(std::uint32_t index) const {
    return known_.knows(index) ? known_[index] : unknown_letter(index);
  }

  void set_letter(std::uint32_t index, Range range) {
    known_.set(index, conditional_ ? join(value_of_letter(index), range) : range);
  }

  // ---- lines

  /// Forgets all values: the line can be reached from elsewhere.
  void begin_block() {
    known_.begin_block();
    data_ = {};
    cleared_ = 0;
    counting_ = 0;
  }

  void check_lines() {
    bool falls = false;
    for (const auto& code : flow_.code) {
      if (code.target || !falls)
        begin_block();
      line_end_ = program_.lines[code.line].span.end;
      cleared_on_line_ = 0;
      const auto& statement = program_.statements[code.statement];
      check(statement);
      check_branches(statement);
      if (code.jumps_begin != code.jumps_end || statement.error)
        counting_ = 0;                        // the loop may be left early
      falls = code.falls && !statement.error; // a line that does not parse may set anything
      for (const auto& jump : flow_.jumps_of(code))
        if (jump.call)
          falls = false; // the subroutine may change everything
      in_order_ = in_order_ && falls;
    }
  }

  void check_branches(const StatementNode& statement) {
    conditional_ = true;
    const auto cleared = cleared_on_line_;
    for (const auto& branch : program_.whole(statement).subspan(1)) {
      cleared_on_line_ = cleared;
      check(branch);
    }
    conditional_ = false;
  }

  void check(const StatementNode& statement) {
    if (statement.error)
      return;
    evaluate(statement);
    const auto& row = spec::info(statement.kind);
    if (row.after == spec::After::Waits)
      cleared_ = 0;
    switch (row.form) {
    case spec::Form::Assignment: check_let(program_.as<LetView>(statement)); break;
    case spec::Form::Loop: check_for(program_.as<ForView>(statement)); break;
    case spec::Form::LoopEnd: forget(program_.items_of(statement)); break;
    case spec::Form::IndexedBranch: check_on(program_.as<OnView>(statement)); break;
    case spec::Form::Output: check_print(statement); break;
    case spec::Form::Entry: check_input(statement); break;
    case spec::Form::Values: check_data(statement); break;
    case spec::Form::Variables: check_read(statement); break;
    case spec::Form::Arguments: check_arguments(statement); break;
    case spec::Form::Conditional:
    case spec::Form::Branch: break;
    }
  }

  const Range& range_of(const Item& expression) const { return ranges_[expression.value]; }

  void check_range(const Item& value, std::string_view word, const spec::Parameter& parameter) {
    const auto& range = range_of(value);
    if (parameter.least <= range.lo && range.hi <= parameter.greatest)
      return;
    if (range.misses(parameter.least, parameter.greatest))
      add_out_of_range(value, word, parameter);
    else
      check_loop_range(value, word, parameter);
  }

  void add_out_of_range(const Item& value, std::string_view word,
                        const spec::Parameter& parameter) {
    const auto name = parameter.name.empty() ? "" : fmt::format("{} ", parameter.name);
    findings_.add(rules::ValueOutOfRange, value.span,
                  fmt::format("`{}` takes {}{} to {}, found {}", word, name, parameter.least,
                              parameter.greatest, shown(range_of(value))));
  }

  /// A loop that nothing leaves early reaches both ends of its range, and so does what is computed
  /// from its letter by `+`, `-` and `*` alone.
  void check_loop_range(const Item& value, std::string_view word,
                        const spec::Parameter& parameter) {
    const auto& root = program_.nodes[value.value];
    std::uint32_t counters = 0;
    for (auto n = root.first; n <= value.value; ++n) {
      const auto& node = program_.nodes[n];
      if (node.kind == NodeKind::Letter && (counting_ & bit(node.what)) != 0)
        ++counters;
      else if (node.kind != NodeKind::Number && node.kind != NodeKind::Group &&
               (node.kind != NodeKind::Binary || !keeps_ends(node)))
        return;
    }
    const bool wraps = range_of(value) == Range{};
    if (counters != 1 || conditional_ || wraps)
      return;
    const auto text = program_.text_of(value.span);
    auto& d = findings_.add(rules::LoopLeavesRange, value.span,
                            fmt::format("`{}` takes {} {} to {}, and `{}` counts {} here", word,
                                        parameter.name, parameter.least, parameter.greatest, text,
                                        shown(range_of(value))));
    const bool heading = parameter.greatest + 1 == full_turn && range_of(value).lo >= 0;
    const bool single = root.kind == NodeKind::Letter;
    if (heading) {
      d.help =
          fmt::format("write `{}{}{} % {}`", single ? "" : "(", text, single ? "" : ")", full_turn);
      d.fix = Fix{d.help,
                  {{{value.span.begin, value.span.begin}, single ? "" : "("},
                   {{value.span.end, value.span.end},
                    fmt::format("{} % {}", single ? "" : ")", full_turn)}},
                  Safety::Safe};
    } else if (single && range_of(value).hi > parameter.greatest) {
      d.help = fmt::format("let the loop end at {}", parameter.greatest);
    }
  }

  static bool keeps_ends(const Node& node) {
    const auto op = static_cast<spec::Operator>(node.what);
    return op == spec::Operator::Add || op == spec::Operator::Subtract ||
           op == spec::Operator::Multiply;
  }

  void check_arguments(const StatementNode& statement) {
    const auto& row = spec::info(statement.kind);
    const auto parameters = row.parameters();
    const auto arguments = program_.items_of(statement);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      check_range(arguments[i], row.word, parameters[i]);
    if (statement.kind == spec::Statement::Goroll && arguments.size() < parameters.size())
      add_missing_go(statement, arguments.back());
    if (statement.kind == spec::Statement::Basflg)
      check_flags(arguments.front());
    if (statement.kind == spec::Statement::Sleep)
      check_sleep(program_.as<SleepView>(statement).line);
    if (statement.kind == spec::Statement::Rstr)
      data_.left = conditional_ ? DataSet::unknown : data_.size;
  }

  void add_missing_go(const StatementNode& statement, const Item& last) {
    const auto speed = range_of(last);
    auto& d = findings_.add(rules::MissingGo, statement.span, "`goroll` takes 3 values, found 2",
                            "add the go value: 1 drives, 0 brakes");
    const auto end = last.span.end;
    if (speed.constant())
      d.fix =
          single_fix("add the go value", {end, end}, speed.lo > 0 ? ",1" : ",0", Safety::Unsafe);
  }

  void check_flags(const Item& value) {
    const auto range = range_of(value);
    const auto all = spec::value_of(spec::Limit::GreatestBasicFlags);
    if (range.lo > all &&
        !range.misses(0, spec::info(spec::Statement::Basflg).parameters()[0].greatest))
      findings_.add(rules::UnknownFlags, value.span,
                    fmt::format("the flags are 1, 2, 4 and 8, found {}", shown(range)));
  }

  /// The line that runs after waking lies in flash; that is this program only when it is meant for
  /// flash.
  void check_sleep(const Item& value) {
    const auto range = range_of(value);
    if (!range.constant() || range.lo < 1 ||
        range.misses(1, spec::value_of(spec::Limit::GreatestLineNumber)))
      return;
    const auto* number = flow_.find(static_cast<std::uint32_t>(range.lo));
    if (number != nullptr && number->code != none)
      return;
    auto& d = findings_.add(number == nullptr ? rules::MissingTarget : rules::EmptyTarget,
                            value.span, fmt::format("there is no line {} to wake up at", range.lo));
    if (target_.area == Area::Ram) {
      d.severity = Severity::Info;
      d.help = "the line is looked up in the flash area, which this program does not fill";
    }
  }

  void check_let(const LetView& let) {
    const auto& [variable, value] = let;
    if (variable.kind == ItemKind::Letter) {
      set_letter(variable.value, range_of(value));
    } else if (variable.kind == ItemKind::Indexed) {
      check_index(variable.span);
    } else if (static_cast<spec::Variable>(variable.value) != spec::Variable::Ctrl) {
      const auto& row = spec::variables[variable.value];
      check_range(value, row.word, {"", row.least, row.greatest, row.unit});
    }
  }

  void check_for(const ForView& loop) {
    const auto& variable = loop.variable;
    const auto start = range_of(loop.start);
    const auto end = range_of(loop.end);
    const auto step = loop.step != nullptr ? range_of(*loop.step) : Range::only(1);
    if (step == Range::only(0))
      findings_.add(rules::ZeroStep, loop.step->span, "the step of the loop is 0");
    const bool away = (step.lo > 0 && start.lo > end.hi) || (step.hi < 0 && start.hi < end.lo);
    if (away) {
      auto& d = findings_.add(rules::LoopRunsOnce, {loop.start.span.begin, loop.last().span.end},
                              fmt::format("the loop counts from {} away from {}, so it runs once",
                                          shown(start), shown(end)));
      if (loop.step == nullptr)
        d.help = "to count down write `step -1`";
    }
    if (variable.kind == ItemKind::Indexed) {
      findings_.add(rules::IndexedLoop, variable.span, "the loop counts in `Z`",
                    "count in one of A to X");
      check_index(variable.span);
      return;
    }
    // The first line of the body is entered from here and from `next`: of all letters only the
    // loop's own is known there, and only when nothing else sets it.
    begin_block();
    if (letters_[variable.value].assigned)
      return;
    set_letter(variable.value, join(start, end));
    if (!start.constant() || !end.constant() || !step.constant() || step.lo == 0 || away)
      return;
    const auto rounds = (std::int64_t{end.lo} - start.lo) / step.lo;
    set_letter(variable.value,
               join(start, Range::only(static_cast<std::int32_t>(start.lo + rounds * step.lo))));
    if (!conditional_)
      counting_ |= bit(variable.value);
  }

  /// A variable gets a value that is not known.
  void forget(std::span<const Item> variables) {
    for (const auto& variable : variables) {
      if (variable.kind == ItemKind::Letter)
        set_letter(variable.value, {});
      else if (variable.kind == ItemKind::Indexed)
        check_index(variable.span);
    }
  }

  void check_index(Span span) {
    indexed_used_ = true;
    const auto& index = letters_[index_letter];
    const auto range = value_of_letter(index_letter);
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    if (range.misses(1, most)) {
      auto& d = findings_.add(
          rules::IndexRange, span,
          index.first_set == nullptr
              ? "`Z` is used, but `Y` is never set and 0 names no element"
              : fmt::format("`Z` is used while `Y` is {}; it must be 1 to {}", shown(range), most));
      if (index.first_set == nullptr)
        d.help = "`Z` is the list element that `Y` names; use another letter";
    } else if (index.first_set != nullptr && index.first_set->span.begin > line_end_ && in_order_ &&
               !before_y_) {
      before_y_ = true;
      findings_.add(rules::IndexBeforeY, span, "`Z` is used above the first line that sets `Y`",
                    "set `Y` to 1 … 25 first");
    }
  }

  void check_on(const OnView& on) {
    const auto& [selector, targets] = on;
    const auto count = static_cast<std::int32_t>(targets.size());
    const auto range = range_of(selector);
    if (range.misses(1, count))
      findings_.add(
          rules::SelectorRange, selector.span,
          fmt::format("the list has {}, found {}", plural(targets.size(), "line"), shown(range)));
  }

  void check_print(const StatementNode& statement) {
    std::uint64_t least = 0;
    std::uint64_t most = 0;
    const auto items = program_.items_of(statement);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& part = items[i];
      if (part.kind == ItemKind::String) {
        least += part.span.size() - 2;
        most += part.span.size() - 2;
      } else if (part.kind == ItemKind::Expression) {
        const auto digits = printed(range_of(part));
        least += digits.least;
        most += digits.most;
      } else if (part.kind == ItemKind::Semicolon) {
      } else {
        ++least;
        ++most;
      }
    }
    const auto limit = static_cast<std::uint64_t>(spec::value_of(spec::Limit::PrintBytes));
    if (least > limit)
      findings_.add(rules::PrintTooLong, statement.span,
                    fmt::format("the print takes at least {} bytes; the limit is {}", least, limit),
                    "end the first part with `;` and print the rest on the next line");
    else if (most > limit)
      findings_.add(rules::PrintMayBeTooLong, statement.span,
                    fmt::format("the print can take {} bytes; the limit is {}", most, limit));
  }

  void check_input(const StatementNode& statement) {
    const auto input = program_.as<InputView>(statement);
    forget({&input.variable, 1});
    const auto& row = spec::info(statement.kind);
    if (input.milliseconds != nullptr)
      check_range(*input.milliseconds, row.word, row.parameters()[0]);
  }

  void check_data(const StatementNode& statement) {
    if (data_.unread != nullptr && !conditional_) {
      auto& d =
          findings_.add(rules::DataReplaced, statement.word,
                        "these values replace those of the line before, which were never read",
                        "put all values on one line");
      add_note(d, data_.unread->span, "the values that are lost");
    }
    const auto count = static_cast<std::uint32_t>(program_.items_of(statement).size());
    data_.size =
        std::min(count, static_cast<std::uint32_t>(spec::value_of(spec::Limit::DataValues)));
    data_.left = conditional_ ? DataSet::unknown : data_.size;
    data_.unread = conditional_ ? nullptr : &statement;
  }

  void check_read(const StatementNode& statement) {
    const auto variables = program_.items_of(statement);
    const auto count = static_cast<std::uint32_t>(variables.size());
    forget(variables);
    data_.unread = nullptr;
    if (conditional_) {
      data_.left = DataSet::unknown;
    } else if (data_.left == DataSet::unknown) {
      if (!has_data())
        findings_.add(rules::ReadPastData, statement.span, "there is no `data` to read",
                      "add a `data` line above");
    } else if (count > data_.left) {
      findings_.add(rules::ReadPastData, statement.span,
                    fmt::format("{} value{} left in the data, {} read here", data_.left,
                                data_.left == 1 ? " is" : "s are", count));
      data_.left = DataSet::unknown;
    } else {
      data_.left -= count;
    }
  }

  bool has_data() {
    if (!has_data_)
      has_data_ = std::any_of(program_.statements.begin(), program_.statements.end(),
                              [](const StatementNode& statement) {
                                return statement.error || statement.kind == spec::Statement::Data;
                              });
    return *has_data_;
  }

  // ---- expressions

  /// Goes through the nodes of a statement in the order in which they are computed. They stand
  /// right after those of the statement before.
  void evaluate(const StatementNode& statement) {
    const auto items = program_.items_of(statement);
    const auto last = std::find_if(items.rbegin(), items.rend(), [](const Item& item) {
      return item.kind == ItemKind::Expression || item.kind == ItemKind::Character;
    });
    if (last == items.rend())
      return;
    for (auto n = evaluated_; n <= last->value; ++n)
      ranges_[n] = evaluate(n);
    evaluated_ = last->value + 1;
  }

  Range evaluate(std::uint32_t index) {
    const auto& node = program_.nodes[index];
    switch (node.kind) {
    case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
    case NodeKind::Letter:
      if (letters_[node.what].first_used == nullptr)
        letters_[node.what].first_used = &node;
      return value_of_letter(node.what);
    case NodeKind::Indexed: check_index(node.span); return {};
    case NodeKind::System: return read_system(node);
    case NodeKind::Group: return ranges_[index - 1];
    case NodeKind::Negate: return negate(ranges_[index - 1]);
    case NodeKind::Binary: return evaluate_binary(node, index);
    case NodeKind::Call: return evaluate_call(node, index);
    }
    return {};
  }

  Range read_system(const Node& node) {
    const auto& row = spec::variables[node.what];
    if (row.access == spec::Access::ReadClears)
      note_clearing(node, row);
    return {row.least, row.greatest};
  }

  void note_clearing(const Node& node, const spec::VariableInfo& row) {
    std::uint32_t slot = 0; // few variables clear themselves; their order is their slot
    for (const auto& other : spec::variables) {
      if (other.variable == row.variable)
        break;
      slot += other.access == spec::Access::ReadClears ? 1 : 0;
    }
    if (((cleared_on_line_ | cleared_) & bit(slot)) != 0)
      findings_.add(rules::ClearedByReading, node.span,
                    fmt::format("`{}` is read again, but the previous read has already set it to 0",
                                row.word),
                    "copy it into a variable and use that");
    cleared_on_line_ |= bit(slot);
    if (!conditional_)
      cleared_ |= bit(slot);
  }

  Range evaluate_binary(const Node& node, std::uint32_t index) {
    const auto op = static_cast<spec::Operator>(node.what);
    const auto right_index = index - 1;
    const auto& right = ranges_[right_index];
    const auto& left = ranges_[program_.nodes[right_index].first - 1];
    const auto& right_span = program_.nodes[right_index].span;
    const bool divides = op == spec::Operator::Divide || op == spec::Operator::Remainder;
    const bool shifts = op == spec::Operator::ShiftLeft || op == spec::Operator::ShiftRight;
    if (divides && right == Range::only(0)) {
      findings_.add(rules::DivisionByZero, right_span, "the divisor is 0");
      return {};
    }
    const auto most = spec::value_of(spec::Limit::GreatestShift);
    if (shifts && right.misses(0, most)) {
      findings_.add(rules::ValueOutOfRange, right_span,
                    fmt::format("a shift is by 0 to {} bits, found {}", most, shown(right)));
      return {};
    }
    return apply(op, left, right);
  }

  Range evaluate_call(const Node& node, std::uint32_t index) {
    const auto& row = spec::functions[node.what];
    const auto& range = ranges_[index - 1];
    if (!range.misses(row.least, row.greatest))
      return apply(row.function, range);
    findings_.add(
        rules::ValueOutOfRange, program_.nodes[index - 1].span,
        fmt::format("`{}` takes {} or more, found {}", row.word, row.least, shown(range)));
    return {};
  }

  const Program& program_;
  const Flow& flow_;
  const Target& target_;
  Findings& findings_;
  std::array<Letter, letters> letters_{};
  std::vector<Range> ranges_;   ///< by node
  std::uint32_t evaluated_ = 0; ///< how many of them are known

  // what is known on the way through a block
  KnownLetters known_;
  DataSet data_;
  std::uint32_t cleared_ = 0;         ///< variables that are 0 because they have been read
  std::uint32_t cleared_on_line_ = 0; ///< the same, by this line
  std::uint32_t counting_ = 0;        ///< letters of loops that reach their ends for certain
  std::uint32_t line_end_ = 0;
  bool conditional_ = false; ///< in a branch

  bool indexed_used_ = false;
  bool in_order_ = true; ///< nothing above leads away and back, or past lines
  bool before_y_ = false;
  std::optional<bool> has_data_;
};

} // namespace

void lint_values(const Program& program, const Flow& flow, const Target& target,
                 Findings& findings) {
  ValuesPass(program, flow, target, findings).run();
}

} // namespace orb::compiler
