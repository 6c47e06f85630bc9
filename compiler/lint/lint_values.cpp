#include "base/text.h"
#include "compiler/lint/lint_passes.h"

#include "compiler/lint/letters.h"
#include "compiler/lint/range.h"
#include "compiler/lint/reading.h"
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

/// What is known about the values that `read` takes.
struct DataSet {
  static constexpr std::uint32_t unknown = none;

  std::uint32_t size = unknown;
  std::uint32_t left = unknown;
  const StatementNode* unread = nullptr; ///< the `data` that nothing has read yet
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
        ranges_(program.nodes.size()), exact_(program.nodes.size()), ways_(program, flow) {}

  /// Carries values through straight runs of lines only, and forgets them where a jump comes in.
  void run() {
    collect_letters();
    check_lines();
    check_letters();
  }

  /// Whether following all ways could say more: something that is not known here is set, somewhere,
  /// to what is not allowed here.
  bool may_say_more() {
    following_ = true; // computes anew
    for (std::uint32_t i = 0; i < letters; ++i)
      now_.ranges[i] = given_[i].value_or(Range{});
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    const auto& index = given_[index_letter];
    if (index_doubt_ && index && (index->lo < 1 || index->hi > most))
      return true;
    if (std::any_of(questions_.begin(), questions_.end(), [&](const Question& question) {
          const auto& given = given_[question.letter];
          return given && !given->constant() && !given->has(question.number);
        }))
      return true;
    return std::any_of(doubts_.begin(), doubts_.end(), [&](const Doubt& doubt) {
      for (auto n = program_.nodes[doubt.root].first; n <= doubt.root; ++n)
        ranges_[n] = compute(n);
      const auto& range = ranges_[doubt.root];
      return range != Range{} && (range.lo < doubt.least || range.hi > doubt.greatest);
    });
  }

  /// The same with all ways followed.
  void run_followed() {
    collect_letters();
    if (ways_.prepare())
      follow();
    check_lines();
    check_letters();
  }

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

  void doubt(const Item& value, std::int64_t least, std::int64_t greatest) {
    if (!followed_)
      doubts_.push_back({value.value, least, greatest});
  }

  /// Notes what a letter is set to, where that is known by itself.
  void note_given(std::uint32_t letter, Range range, const Node* root) {
    if (followed_ || following_ || range == Range{})
      return;
    if (range.lo < 0 && root != nullptr && is_wrapped(*root))
      range.lo = 0;
    auto& given = given_[letter];
    given = given ? join(*given, range) : range;
  }

  /// Whether a value is a sum wrapped around by `%`, which is never negative where its parts are
  /// not.
  bool is_wrapped(const Node& root) const {
    if (root.kind != NodeKind::Binary ||
        static_cast<spec::Operator>(root.what) != spec::Operator::Remainder)
      return false;
    for (const auto* node = &program_.nodes[root.first]; node != &root; ++node)
      if (node->kind == NodeKind::Negate ||
          (node->kind == NodeKind::Binary &&
           static_cast<spec::Operator>(node->what) == spec::Operator::Subtract))
        return false;
    return true;
  }

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

  /// Forgets what letters are.
  void forget_letters() {
    now_ = Letters::zero();
    for (std::uint32_t i = 0; i < letters; ++i)
      if (letters_[i].first_set != nullptr)
        set_letter(i, {});
  }

  void set_letter(std::uint32_t index, Range range) { set_letter(index, range, 0, 0); }
  /// `exact` and `dense`: 1 or 0.
  void set_letter(std::uint32_t index, Range range, std::uint32_t exact, std::uint32_t dense) {
    now_.ranges[index] = range;
    now_.exact = (now_.exact & ~bit(index)) | exact << index;
    now_.dense = (now_.dense & ~bit(index)) | (exact & dense) << index;
    if (index == index_letter)
      index_begins_.reset();
  }

  // ---- ways

  void follow() {
    following_ = true;
    find_data();
    ways_.enter(0, Letters::zero());
    for (auto code = ways_.take(); code != none; code = ways_.take())
      follow(code);
    following_ = false;
    followed_ = true;
  }

  void follow(std::uint32_t begin) {
    now_ = *ways_.before(begin);
    block_ = begin;
    for (auto i = begin; i < flow_.code.size(); ++i) {
      if (i > begin && ways_.is_kept(i)) {
        ways_.enter(i, now_);
        return;
      }
      if (!go(i))
        return;
    }
  }

  /// The values that `read` can take.
  void find_data() {
    bool any = false;
    forget_letters();
    for (const auto& statement : program_.statements) {
      if (statement.error || statement.kind != spec::Statement::Data)
        continue;
      for (const auto& item : program_.items_of(statement)) {
        const auto range = compute(item);
        data_range_ = any ? join(data_range_, range) : range;
        any = true;
      }
    }
  }

  /// Runs a line on what is known; whether the one below can be next.
  bool go(std::uint32_t code) {
    const auto& statement = program_.statements[flow_.code[code].statement];
    look(statement);
    if (statement.error) {
      forget_letters(); // it may do anything, once corrected
      return flow_.code[code].falls;
    }
    if (statement.then_branch == none)
      return move(statement, code);
    if (following_)
      for (const auto& item : program_.items_of(statement))
        if (item.kind == ItemKind::Expression)
          compute(item);
    return go_branches(statement, code);
  }

  bool go_branches(const StatementNode& statement, std::uint32_t code) {
    const auto before = now_;
    const auto condition = program_.as<IfView>(statement);
    const auto* otherwise =
        statement.else_branch == none ? nullptr : &program_.statements[statement.else_branch];
    conditional_ = true;
    const auto cleared = cleared_on_line_;
    const bool then_falls =
        go_branch(condition, Holds::Yes, &program_.statements[statement.then_branch], code);
    auto after = now_;
    now_ = before;
    cleared_on_line_ = cleared;
    const bool else_falls = go_branch(condition, Holds::No, otherwise, code);
    conditional_ = false;
    if (then_falls && else_falls) {
      const auto looked_at = now_.exact | after.exact;
      join_into(now_, after);
      // What a test looks at and both ways keep is treated by the other statement somehow.
      now_.exact &= ~(looked_at & tested_);
    } else if (then_falls) {
      now_ = after;
    }
    tested_ = 0;
    return then_falls || else_falls;
  }

  bool go_branch(const IfView& condition, Holds holds, const StatementNode* branch,
                 std::uint32_t code) {
    const bool can_be = assume(condition, holds);
    if (branch == nullptr)
      return can_be;
    if (!can_be && following_)
      return false;
    look(*branch);
    if (branch->error) {
      forget_letters();
      return true;
    }
    const bool falls = move(*branch, code);
    if (branch->kind == spec::Statement::Let)
      tested_ &= ~bit(program_.as<LetView>(*branch).variable.value);
    return falls && can_be;
  }

  /// Narrows the letters of a condition to where it holds or not; false where that cannot be.
  bool assume(const IfView& condition, Holds holds) {
    if (condition.joint == nullptr)
      return assume(condition.first, holds);
    if ((condition.joint->kind == ItemKind::And) != (holds == Holds::Yes))
      return true; // either of the two
    return assume(condition.first, holds) && assume(*condition.second, holds);
  }

  bool assume(const Comparison& comparison, Holds holds) {
    const auto relation = static_cast<spec::Relation>(comparison.relation.value);
    const auto left = ranges_[comparison.left.value];
    const auto right = ranges_[comparison.right.value];
    const auto left_where = where(relation, holds, left, right);
    const auto right_where = where(mirrored(relation), holds, right, left);
    if (!left_where || !right_where)
      return false;
    narrow(comparison.left, left, *left_where);
    narrow(comparison.right, right, *right_where);
    return true;
  }

  void narrow(const Item& side, const Range& from, const Range& to) {
    const auto letter = letter_in(program_, side);
    if (!letter || now_.ranges[*letter] != from || from == to)
      return;
    tested_ |= bit(*letter);
    const auto dense = now_.dense >> *letter & 1;
    set_letter(*letter, to, dense, dense);
  }

  /// What a statement does to letters and where it leads; whether the line below can be next.
  bool move(const StatementNode& statement, std::uint32_t code) {
    switch (spec::info(statement.kind).form) {
    case spec::Form::Assignment: set(program_.as<LetView>(statement)); return true;
    case spec::Form::Loop: begin_loop(program_.as<ForView>(statement), code); return true;
    case spec::Form::LoopEnd: return end_loop(program_.as<NextView>(statement));
    case spec::Form::Entry: forget(program_.items_of(statement).first(1)); return true;
    case spec::Form::Variables: read(program_.items_of(statement)); return true;
    case spec::Form::Branch:
    case spec::Form::IndexedBranch: return jump(statement, code);
    case spec::Form::Arguments:
      if (statement.kind == spec::Statement::Return && following_)
        ways_.leave(code, now_);
      if (statement.kind == spec::Statement::Reset && following_)
        ways_.enter(0, Letters::zero());
      return spec::info(statement.kind).after != spec::After::Ends;
    case spec::Form::Conditional:
    case spec::Form::Output:
    case spec::Form::Values: break;
    }
    return true;
  }

  void set(const LetView& let) {
    if (let.variable.kind != ItemKind::Letter)
      return;
    const auto range = compute(let.expression);
    const auto& root = program_.nodes[let.expression.value];
    const bool spread = root.kind == NodeKind::Binary &&
                        static_cast<spec::Operator>(root.what) == spec::Operator::Multiply;
    const std::uint32_t exact = exact_[let.expression.value];
    const bool number = range.constant();
    note_given(let.variable.value, range, &root);
    set_letter(let.variable.value, range, exact, spread || number ? 0 : exact);
  }

  /// All that the letter of a loop is in its body, where nothing else sets it.
  Range rounds(const ForView& loop, const Range& start, const Range& end, const Range& step) const {
    if (step.lo <= 0 && step.hi >= 0)
      return {};
    const bool up = step.lo > 0;
    if (start.constant() && end.constant() && step.constant() &&
        (up ? start.lo <= end.lo : start.lo >= end.lo) && !letters_[loop.variable.value].assigned) {
      const auto last = (std::int64_t{end.lo} - start.lo) / step.lo * step.lo + start.lo;
      return join(start, Range::only(static_cast<std::int32_t>(last)));
    }
    return up ? Range{start.lo, std::max(start.hi, end.hi)}
              : Range{std::min(start.lo, end.lo), start.hi};
  }

  void begin_loop(const ForView& loop, std::uint32_t code) {
    if (loop.variable.kind != ItemKind::Letter)
      return;
    const auto start = compute(loop.start);
    set_letter(loop.variable.value, start); // before the end is computed
    const auto end = compute(loop.end);
    const auto step = loop.step != nullptr ? compute(*loop.step) : Range::only(1);
    const auto body = rounds(loop, start, end, step);
    note_given(loop.variable.value, body, nullptr);
    set_letter(loop.variable.value, body);
    if (loop.variable.value == index_letter && start.constant())
      index_begins_ = start.lo;
    if (!following_)
      return;
    const auto at = std::find_if(loops_.begin(), loops_.end(),
                                 [&](const Loop& one) { return one.code == code; });
    if (at == loops_.end())
      loops_.push_back({code, loop.variable.value, end, step, body});
    else
      *at = {code, at->letter, join(at->end, end), join(at->step, step), join(at->body, body)};
  }

  /// `next` leads back to the line below each `for` of its letter that can be open.
  bool end_loop(const NextView& next) {
    if (next.variable.kind != ItemKind::Letter)
      return true;
    const auto letter = next.variable.value;
    const auto before = now_;
    std::optional<Range> past;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (loops_[i].letter != letter)
        continue;
      if (const auto left = next_of(loops_[i], before))
        past = past ? join(*past, *left) : *left;
    }
    now_ = before;
    if (!followed_or_following()) {
      set_letter(letter, {});
      return true;
    }
    if (!past)
      return false;
    set_letter(letter, *past);
    return true;
  }

  bool followed_or_following() const { return following_ || followed_; }

  /// Goes back to the body of a loop; what its letter is where the loop is over, if it can be.
  std::optional<Range> next_of(const Loop& loop, const Letters& before) {
    const auto stepped = apply(spec::Operator::Add, before.ranges[loop.letter], loop.step);
    const bool fixed = loop.step.lo > 0 || loop.step.hi < 0;
    const auto over = loop.step.lo > 0 ? spec::Relation::Greater : spec::Relation::Less;
    const auto within = fixed ? where(over, Holds::No, stepped, loop.end) : stepped;
    if (within && following_) {
      now_ = before;
      set_letter(loop.letter, letters_[loop.letter].assigned ? *within : loop.body);
      ways_.enter(loop.code + 1, now_);
    }
    return fixed ? where(over, Holds::Yes, stepped, loop.end) : stepped;
  }

  void read(std::span<const Item> variables) {
    for (const auto& variable : variables)
      if (variable.kind == ItemKind::Letter)
        set_letter(variable.value, data_range_);
  }

  bool jump(const StatementNode& statement, std::uint32_t code) {
    const bool calls =
        statement.kind == spec::Statement::Gosub || statement.spelling == Spelling::OnGosub;
    if (!following_ && !calls)
      return false;
    const auto before = now_;
    std::optional<Letters> after;
    for (const auto& way : flow_.jumps_of(flow_.code[code])) {
      if (way.item < statement.items_begin || way.item >= statement.items_end || way.to == none)
        continue;
      if (!way.call) {
        ways_.enter(way.to, before);
        continue;
      }
      now_ = before;
      if (!followed_or_following() || !ways_.call(way.to, block_, now_))
        continue;
      if (after)
        join_into(*after, now_);
      else
        after = now_;
    }
    now_ = before;
    if (!calls)
      return false;
    if (after)
      now_ = *after;
    else if (!following_)
      forget_letters();
    return after.has_value() || !following_;
  }

  // ---- lines

  /// Forgets what was noted on the way: the line can be reached from elsewhere.
  void begin_block() {
    data_ = {};
    cleared_ = 0;
    counting_ = 0;
    index_begins_.reset();
  }

  void check_lines() {
    bool falls = false;
    forget_letters();
    for (std::uint32_t i = 0; i < flow_.code.size(); ++i) {
      const auto& code = flow_.code[i];
      if (code.target || !falls)
        begin_block();
      begin_line(i, falls);
      line_end_ = program_.lines[code.line].span.end;
      cleared_on_line_ = 0;
      const auto& statement = program_.statements[code.statement];
      go(i);
      if (code.jumps_begin != code.jumps_end || statement.error)
        counting_ = 0;                        // the loop may be left early
      falls = code.falls && !statement.error; // a line that does not parse may set anything
      for (const auto& jump : flow_.jumps_of(code))
        if (jump.call)
          falls = false; // the subroutine may change everything
      in_order_ = in_order_ && falls;
    }
  }

  /// Takes up what is known of the letters at a line.
  void begin_line(std::uint32_t code, bool falls) {
    if (followed_ && ways_.is_kept(code)) {
      block_ = code;
      if (const auto* known = ways_.before(code)) {
        now_ = *known;
        return;
      }
      forget_letters();
    } else if (!followed_ && (flow_.code[code].target || !falls)) {
      forget_letters();
    }
  }

  /// Looks for mistakes in a statement, unless the ways are still being followed.
  void look(const StatementNode& statement) {
    if (following_ || statement.error)
      return;
    evaluate(statement);
    const auto& row = spec::info(statement.kind);
    if (row.after == spec::After::Waits)
      cleared_ = 0;
    switch (row.form) {
    case spec::Form::Assignment: check_let(program_.as<LetView>(statement)); break;
    case spec::Form::Loop: check_for(program_.as<ForView>(statement)); break;
    case spec::Form::LoopEnd: check_indexed(program_.items_of(statement)); break;
    case spec::Form::IndexedBranch: check_on(program_.as<OnView>(statement)); break;
    case spec::Form::Output: check_print(statement); break;
    case spec::Form::Entry: check_input(statement); break;
    case spec::Form::Values: check_data(statement); break;
    case spec::Form::Variables: check_read(statement); break;
    case spec::Form::Arguments: check_arguments(statement); break;
    case spec::Form::Conditional: check_condition(program_.as<IfView>(statement)); break;
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
    else if (!check_loop_range(value, word, parameter)) {
      if (exact_[value.value] != 0)
        check_may_leave(value, word, parameter);
      else
        doubt(value, parameter.least, parameter.greatest);
    }
  }

  void check_may_leave(const Item& value, std::string_view word, const spec::Parameter& parameter) {
    const auto& range = range_of(value);
    if (range.lo == Range{}.lo || range.hi == Range{}.hi)
      return; // nobody knows by how much
    const auto kind = program_.nodes[value.value].kind;
    const bool single =
        kind == NodeKind::Letter || kind == NodeKind::System || kind == NodeKind::Group;
    const auto text = program_.text_of(value.span);
    const auto whole = single ? std::string(text) : fmt::format("({})", text);
    const auto turn = std::int64_t{parameter.greatest} + 1;
    std::string help;
    if (range.lo == 1 && range.hi == turn)
      help = fmt::format("write `{} - 1`", whole);
    else if (range.lo >= 0)
      help = fmt::format("write `{} % {}`", whole, turn);
    else if (turn == full_turn && range.lo >= -full_turn)
      help = fmt::format("write `({} + {}) % {}`", text, full_turn, full_turn);
    else
      help = fmt::format("where it is outside, set it to {} or {} first", parameter.least,
                         parameter.greatest);
    const auto name = parameter.name.empty() ? "" : fmt::format("{} ", parameter.name);
    add_may_leave(
        value,
        fmt::format("`{}` takes {}{} to {}", word, name, parameter.least, parameter.greatest),
        help);
  }

  void add_may_leave(const Item& value, const std::string& allowed, const std::string& help) {
    findings_.add(rules::MayLeaveRange, value.span,
                  fmt::format("{}, and `{}` can be {}", allowed, program_.text_of(value.span),
                              shown(range_of(value))),
                  help);
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
  /// Whether it said so.
  bool check_loop_range(const Item& value, std::string_view word,
                        const spec::Parameter& parameter) {
    const auto& root = program_.nodes[value.value];
    std::uint32_t counters = 0;
    for (auto n = root.first; n <= value.value; ++n) {
      const auto& node = program_.nodes[n];
      if (node.kind == NodeKind::Letter && (counting_ & bit(node.what)) != 0)
        ++counters;
      else if (node.kind != NodeKind::Number && node.kind != NodeKind::Group &&
               (node.kind != NodeKind::Binary || !keeps_ends(node)))
        return false;
    }
    const bool wraps = range_of(value) == Range{};
    if (counters != 1 || conditional_ || wraps)
      return false;
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
    return true;
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
    if (statement.kind == spec::Statement::Goroll && arguments.size() < parameters.size() &&
        target_.version >= spec::info(spec::BasicGrowth::GoValue).since)
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
    auto& d = findings_.add(rules::MissingGo, statement.span,
                            "`goroll` takes 3 values since orbBasic 1.2 (August 2012), found 2",
                            "add the go value: 1 drives, 0 brakes");
    const auto end = last.span.end;
    if (speed.constant())
      d.fix =
          single_fix("add the go value", {end, end}, speed.lo > 0 ? ",1" : ",0", Safety::Unsafe);
  }

  void check_flags(const Item& value) {
    const auto range = range_of(value);
    for (const auto& row : spec::basic_flags)
      if (range.constant() && (range.lo & static_cast<std::int32_t>(row.flag)) != 0 &&
          row.since > target_.version)
        findings_.add(rules::NewerThanTarget, value.span,
                      fmt::format("flag {} ({}) needs orbBasic {}, the target has {}",
                                  static_cast<int>(row.flag), row.symbol,
                                  spec::info(row.since).text, spec::info(target_.version).text));
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
    if (variable.kind == ItemKind::Indexed) {
      check_index(variable.span);
    } else if (variable.kind != ItemKind::Letter &&
               static_cast<spec::Variable>(variable.value) != spec::Variable::Ctrl) {
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
    begin_block(); // the body is entered from here and from `next`
    if (letters_[variable.value].assigned)
      return;
    if (start.constant() && end.constant() && step.constant() && step.lo != 0 && !away &&
        !conditional_)
      counting_ |= bit(variable.value);
  }

  /// A variable gets a value that is not known.
  void forget(std::span<const Item> variables) {
    for (const auto& variable : variables)
      if (variable.kind == ItemKind::Letter)
        set_letter(variable.value, {});
  }

  void check_indexed(std::span<const Item> variables) {
    for (const auto& variable : variables)
      if (variable.kind == ItemKind::Indexed)
        check_index(variable.span);
  }

  void check_index(Span span) {
    indexed_used_ = true;
    const auto& index = letters_[index_letter];
    const auto range = now_.ranges[index_letter];
    index_doubt_ = index_doubt_ || !is_exact(index_letter);
    const auto most = spec::value_of(spec::Limit::IndexedVariables);
    if (range.misses(1, most)) {
      auto& d = findings_.add(
          rules::IndexRange, span,
          index.first_set == nullptr
              ? "`Z` is used, but `Y` is never set and 0 names no element"
              : fmt::format("`Z` is used while `Y` is {}; it must be 1 to {}", shown(range), most));
      if (index.first_set == nullptr)
        d.help = "`Z` is the list element that `Y` names; use another letter";
    } else if (index_begins_ && (*index_begins_ < 1 || *index_begins_ > most)) {
      findings_.add(
          rules::MayLeaveRange, span,
          fmt::format("`Z` is used while `Y` is {}; it must be 1 to {}", *index_begins_, most),
          *index_begins_ == 0 ? "let `Y` count from 1" : "");
      index_begins_.reset();
    } else if (is_exact(index_letter) && (range.lo < 1 || range.hi > most)) {
      findings_.add(
          rules::MayLeaveRange, span,
          fmt::format("`Z` is used while `Y` can be {}; it must be 1 to {}", shown(range), most),
          fmt::format("keep `Y` within 1 to {}", most));
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
    else if (exact_[selector.value] == 0)
      doubt(selector, 1, count);
    else if (range.lo < 1 || range.hi > count)
      add_may_leave(
          selector, fmt::format("the list has {}", plural(targets.size(), "line")),
          range.hi > count
              ? fmt::format("write {} more",
                            plural(static_cast<std::size_t>(range.hi - count), "line number"))
              : "");
  }

  void check_condition(const IfView& condition) {
    check_answer(condition.first);
    if (condition.second)
      check_answer(*condition.second);
  }

  /// A letter that holds what a sensor or `rnd` gave, compared with what that never is. Sensors
  /// themselves are compared elsewhere.
  void check_answer(const Comparison& comparison) {
    const auto letter = letter_in(program_, comparison.left);
    if (!letter || !number_in(program_, comparison.right) ||
        static_cast<spec::Relation>(comparison.relation.value) != spec::Relation::Equal)
      return;
    if ((now_.dense & bit(*letter)) == 0) {
      if (!now_.ranges[*letter].constant() && !followed_)
        questions_.push_back({*letter, range_of(comparison.right).lo});
      return;
    }
    const auto& range = now_.ranges[*letter];
    const auto& value = range_of(comparison.right);
    if (range.constant() || range.has(value.lo))
      return;
    findings_.add(
        rules::ConstantComparison, Span{comparison.left.span.begin, comparison.right.span.end},
        fmt::format("`{} = {}` is never true: `{}` is {} here", spec::letter_name(*letter),
                    value.lo, spec::letter_name(*letter), shown(range)),
        fmt::format("compare with a number from {} to {}", range.lo, range.hi));
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
    check_indexed({&input.variable, 1});
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
    check_indexed(variables);
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
    // A loop has set its letter to its start when it computes its end.
    const bool counts = statement.kind == spec::Statement::For && items[0].kind == ItemKind::Letter;
    for (auto n = evaluated_; n <= last->value; ++n) {
      ranges_[n] = evaluate(n);
      exact_[n] = exact(n);
      if (counts && n == items[1].value)
        set_letter(items[0].value, ranges_[n]);
    }
    evaluated_ = last->value + 1;
  }

  /// The range of an expression, without looking for mistakes.
  Range compute(const Item& item) {
    if (!following_ && item.value < evaluated_)
      return ranges_[item.value];
    for (auto n = program_.nodes[item.value].first; n <= item.value; ++n) {
      ranges_[n] = compute(n);
      exact_[n] = exact(n);
    }
    return ranges_[item.value];
  }

  Range compute(std::uint32_t index) {
    const auto& node = program_.nodes[index];
    switch (node.kind) {
    case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
    case NodeKind::Letter: return now_.ranges[node.what];
    case NodeKind::Indexed: return {};
    case NodeKind::System: {
      const auto& row = spec::variables[node.what];
      return {row.least, row.greatest};
    }
    case NodeKind::Group: return ranges_[index - 1];
    case NodeKind::Negate: return negate(ranges_[index - 1]);
    case NodeKind::Binary: {
      const auto right = index - 1;
      return apply(static_cast<spec::Operator>(node.what), ranges_[program_.nodes[right].first - 1],
                   ranges_[right]);
    }
    case NodeKind::Call: return apply(spec::functions[node.what].function, ranges_[index - 1]);
    }
    return {};
  }

  bool is_exact(std::uint32_t letter) const { return (now_.exact & bit(letter)) != 0; }

  /// Whether both ends of a node's range are values that it takes.
  bool exact(std::uint32_t index) const {
    const auto& node = program_.nodes[index];
    switch (node.kind) {
    case NodeKind::Number: return !node.overflow;
    case NodeKind::Letter: return is_exact(node.what);
    case NodeKind::Indexed: return false;
    case NodeKind::System: return reaches_ends(spec::variables[node.what]);
    case NodeKind::Group:
    case NodeKind::Negate:
    case NodeKind::Call: return exact_[index - 1] != 0;
    case NodeKind::Binary: return is_exact_sum(node, index - 1);
    }
    return false;
  }

  /// Directions, switches and what clients send take all their values; a ball is never as fast as
  /// its sensors could tell.
  static bool reaches_ends(const spec::VariableInfo& row) {
    constexpr std::int32_t byte = 255; // the greatest value of what a client sends
    return row.unit == "deg" ||
           (row.unit.empty() && row.greatest <= byte && row.variable != spec::Variable::Speed);
  }

  bool is_exact_sum(const Node& node, std::uint32_t right) const {
    const auto left = program_.nodes[right].first - 1;
    if (exact_[left] == 0 || exact_[right] == 0)
      return false;
    const auto& [a, b] = std::pair{ranges_[left], ranges_[right]};
    switch (static_cast<spec::Operator>(node.what)) {
    case spec::Operator::Add:
    case spec::Operator::Subtract:
    case spec::Operator::Multiply: return a.constant() || b.constant();
    case spec::Operator::Divide: return b.constant();
    case spec::Operator::Remainder: // two turns at least, whatever the steps
      return a.constant()
                 ? b.constant()
                 : b.constant() && (std::int64_t{a.hi} - a.lo) / 2 >= std::abs(std::int64_t{b.lo});
    case spec::Operator::ShiftLeft:
    case spec::Operator::ShiftRight:
    case spec::Operator::And:
    case spec::Operator::Or: return a.constant() && b.constant();
    }
    return false;
  }

  Range evaluate(std::uint32_t index) {
    const auto& node = program_.nodes[index];
    switch (node.kind) {
    case NodeKind::Number: return node.overflow ? Range{} : Range::only(node.value);
    case NodeKind::Letter:
      if (letters_[node.what].first_used == nullptr)
        letters_[node.what].first_used = &node;
      return now_.ranges[node.what];
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
    const auto result = apply(op, left, right);
    if (op == spec::Operator::Divide && result == Range::only(0))
      check_quotient(node, index);
    return result;
  }

  void check_quotient(const Node& node, std::uint32_t index) {
    const auto& right = program_.nodes[index - 1];
    const auto& left = program_.nodes[right.first - 1];
    if (left.kind != NodeKind::Number || right.kind != NodeKind::Number || left.value == 0)
      return;
    findings_.add(rules::ZeroQuotient, node.span,
                  fmt::format("`{} / {}` is 0: values are whole numbers", left.value, right.value),
                  fmt::format("multiply first: `x * {} / {}`", left.value, right.value));
  }

  Range evaluate_call(const Node& node, std::uint32_t index) {
    const auto& row = spec::functions[node.what];
    const auto& range = ranges_[index - 1];
    if (row.function == spec::Function::Rnd && range == Range::only(1) &&
        program_.nodes[index - 1].kind != NodeKind::Letter)
      findings_.add(rules::AlwaysOne, node.span, "`rnd 1` is always 1", "write `rnd 2` for 1 or 2");
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
  std::vector<Range> ranges_;       ///< by node
  std::vector<std::uint8_t> exact_; ///< by node: whether it takes both ends of its range
  std::uint32_t evaluated_ = 0;     ///< how many of them are known

  // what is known on the way
  Letters now_;
  LetterFlow ways_;
  std::vector<Loop> loops_; ///< that have been entered
  std::vector<Doubt> doubts_;
  std::vector<Question> questions_;
  bool index_doubt_ = false;                          ///< `Z` is used while `Y` is not known
  std::array<std::optional<Range>, letters> given_{}; ///< what is known by itself, over all lines
  Range data_range_;                                  ///< of the values of all `data`
  std::uint32_t block_ = 0;                           ///< the line from which `now_` is followed
  std::uint32_t tested_ = 0; ///< letters that the condition of this line narrows
  bool following_ = false;
  bool followed_ = false;
  std::optional<std::int32_t> index_begins_; ///< where the loop around counts in `Y`: from there

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

void lint_values(const Program& program, const Flow& flow, const Target& target, Jumps jumps,
                 Findings& findings) {
  auto& all = findings.all();
  const auto before = static_cast<std::ptrdiff_t>(all.size());
  ValuesPass straight(program, flow, target, findings);
  straight.run();
  if (jumps == Jumps::Unknown || !straight.may_say_more())
    return;
  all.erase(all.begin() + before, all.end());
  ValuesPass(program, flow, target, findings).run_followed();
}

} // namespace orb::compiler
