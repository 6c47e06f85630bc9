#include "compiler/analyse/trial_run.h"

#include "compiler/analyse/reading.h"
#include "compiler/analyse/trial_line.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <unordered_set>
#include <utility>

namespace orb::compiler {
namespace {

/// The cause of a decision.
enum class Decider : std::uint8_t {
  World,   ///< a person or chance: either way, at any time
  Program, ///< a value caused by the program: a place, a speed
  Clock,   ///< a timer, which runs out
};

/// Executes a program on all of its paths. Large because each kind of statement has its own member,
/// and so has each way in which paths part and meet.
class TrialRun : private TrialLine {
public:
  TrialRun(const Program& program, const Flow& flow) : TrialLine(program, flow) {}

  Trial run() {
    ways_.push_back(beginning(program_));
    while (!ways_.empty() && lines_ < most_lines) {
      now_ = std::move(ways_.front());
      ways_.pop_front();
      while (now_.at < flow_.code.size() && lines_ < most_lines) {
        const auto from = now_.at;
        go();
        if (now_.at <= from && !is_new()) { // an endless loop, or the same as another path
          note_endless();
          break;
        }
      }
    }
    return std::move(trial_);
  }

private:
  static constexpr std::uint32_t most_lines = 4000; ///< on all paths together
  static constexpr std::size_t most_ways = 64;      ///< pending paths
  static constexpr std::uint32_t most_cycle = 1000; ///< lines of a loop that repeats
  static constexpr std::uint32_t most_probed =
      24; ///< lookahead in lines, for wait loops and paths that meet
  static constexpr std::uint32_t most_joined = 250; ///< rounds in which both paths continue joined
  static constexpr std::size_t most_targets = 8;    ///< targets of an `on` that are followed

  /// True if no path was here before with the same state: when a path returns, and when paths
  /// split.
  bool is_new() { return met_.insert(now_.hash()).second; }
  bool parts_anew() { return parted_.insert(now_.hash()).second; }

  // ---- lines

  void go() {
    ++lines_;
    line_ = now_.at;
    if (now_.decision == none && !probing_)
      ++runs_[line_];
    const auto& statement = program_.statements[flow_.code[line_].statement];
    stopped_ = false;
    now_.at = whole(statement);
    if (stopped_)
      now_.at = none;
  }

  /// Executes a line and returns the next line of code; `none` if this path ends or others continue
  /// in its place.
  std::uint32_t whole(const StatementNode& statement) {
    if (statement.error)
      return none;
    if (spec::info(statement.kind).form == spec::Form::Conditional)
      return branch(statement);
    return step(statement);
  }

  std::uint32_t step(const StatementNode& statement) {
    if (statement.error)
      return none;
    switch (spec::info(statement.kind).form) {
    case spec::Form::Loop: return begin_loop(program_.as<ForView>(statement));
    case spec::Form::LoopEnd: return end_loop(program_.as<NextView>(statement));
    case spec::Form::Branch: return jump(statement, 0);
    case spec::Form::IndexedBranch: return choose(statement);
    case spec::Form::Conditional: return none; // nested in another one
    case spec::Form::Assignment:
    case spec::Form::Output:
    case spec::Form::Entry:
    case spec::Form::Values:
    case spec::Form::Variables:
    case spec::Form::Arguments: break;
    }
    if (statement.kind == spec::Statement::Return)
      return come_back();
    if (spec::info(statement.kind).form == spec::Form::Entry)
      leave_unanswered(program_.as<InputView>(statement), statement.span);
    obey(statement);
    return spec::info(statement.kind).after == spec::After::Ends ? none : line_ + 1;
  }

  /// Follows also the path on which nobody answers, to its first fault.
  void leave_unanswered(const InputView& input, Span span) {
    if (input.fallback == nullptr || probing_ || quiet_ || ways_.size() == most_ways ||
        !parts_anew())
      return;
    auto answered = now_;
    set(input.variable, value(*input.fallback));
    decide(now_, span, &texts::WhenNobodyAnswers);
    now_.at = line_ + 1;
    ways_.push_back(std::exchange(now_, std::move(answered)));
  }

  std::uint32_t begin_loop(const ForView& loop) {
    if (loop.variable.kind != ItemKind::Letter)
      return none;
    const auto letter = loop.variable.value;
    set(loop.variable, value(loop.start));
    const auto end = value(loop.end);
    const auto by = loop.step != nullptr ? value(*loop.step).range : Range::only(1);
    if (by == Range::only(0))
      stop(rules::ZeroStep, loop.step->span, texts::StepIsZero());
    if (!by.constant() || stopped_)
      return none;
    // A `for` on the innermost loop's variable restarts that loop.
    if (!now_.loops.empty() && now_.loops.back().letter == letter)
      now_.loops.pop_back();
    if (now_.loops.size() == static_cast<std::size_t>(spec::value_of(spec::Limit::ForDepth)))
      return none; // reported by another rule
    bind(loop.end);
    now_.loops.push_back({letter, line_ + 1, by.lo, end});
    return line_ + 1;
  }

  std::uint32_t end_loop(const NextView& next) {
    if (next.variable.kind != ItemKind::Letter)
      return none;
    if (now_.loops.empty()) {
      stop(rules::NextWithoutFor, next.variable.span, texts::Without("next", "for"));
      return none;
    }
    auto& loop = now_.loops.back();
    if (loop.letter != next.variable.value) {
      stop(rules::NextWithoutFor, next.variable.span,
           texts::InnermostLoopVariable(program_.text_of(loop_variable(loop.body - 1))));
      return none;
    }
    auto& counter = now_.letters[loop.letter];
    counter = result_of(spec::Operator::Add, counter, Value::only(loop.step));
    const auto over = loop.step > 0 ? Orders::Greater : Orders::Less;
    const auto is_over = answer_of(over, counter.range, loop.end.range);
    if (!is_over)
      return leave_or_not(over);
    if (!*is_over)
      return loop.body;
    now_.loops.pop_back();
    return line_ + 1;
  }

  /// Splits at a `next` whose end value is unknown.
  std::uint32_t leave_or_not(Orders over) {
    const auto& open = now_.loops.back();
    const auto counter = now_.letters[open.letter].range;
    if (!open.end.exact || open.end.ties == Ties::Shared || !counter.constant() ||
        is_settled(open.end.origin))
      return none;
    blur_tied(now_); // the number of rounds tells something of the end
    auto stays = now_;
    auto& loop = stays.loops.back();
    loop.end.range = *where(opposite(mirrored(over)), loop.end.range, counter);
    loop.end.exact = loop.end.dense;
    stays.at = loop.body;
    auto leaves = now_;
    leaves.loops.pop_back();
    leaves.at = line_ + 1;
    decide(stays);
    decide(leaves);
    const auto decider = decider_of(open.end.origin);
    return part({std::move(stays), std::move(leaves)}, decider);
  }

  Span loop_variable(std::uint32_t code) const {
    return program_.items_of(program_.statements[flow_.code[code].statement]).front().span;
  }

  /// Jumps to the line named by the `nth` item of the statement.
  std::uint32_t jump(const StatementNode& statement, std::uint32_t nth) {
    for (const auto& way : flow_.jumps_of(flow_.code[line_])) {
      if (way.item != statement.items_begin + nth || way.to == none)
        continue;
      if (!way.call)
        return way.to;
      if (now_.calls.size() == static_cast<std::size_t>(spec::value_of(spec::Limit::GosubDepth)))
        return none; // reported by another rule
      now_.calls.push_back(line_ + 1);
      return way.to;
    }
    return none;
  }

  std::uint32_t come_back() {
    if (now_.calls.empty())
      return none; // reported by another rule
    const auto at = now_.calls.back();
    now_.calls.pop_back();
    return at;
  }

  std::uint32_t choose(const StatementNode& statement) {
    const auto on = program_.as<OnView>(statement);
    const auto selector = value(on.selector);
    const auto count = static_cast<std::int32_t>(on.targets.size());
    if (selector.range.misses(1, count))
      stop_at(on.selector.span, counted(on.targets.size(), texts::ListHasOne, texts::ListHas),
              selector.range);
    if (stopped_)
      return none;
    if (selector.range.constant())
      return jump(statement, static_cast<std::uint32_t>(selector.range.lo));
    if (!selector.dense || selector.ties == Ties::Shared || on.targets.size() > most_targets ||
        is_settled(selector.origin))
      return none;
    const auto here = now_;
    std::vector<Moment> ways;
    for (auto n = std::max(selector.range.lo, 1); n <= std::min(selector.range.hi, count); ++n) {
      now_ = here;
      narrow(on.selector, Range::only(n));
      now_.at = jump(statement, static_cast<std::uint32_t>(n));
      decide(now_);
      ways.push_back(std::move(now_));
    }
    now_ = here;
    return part(std::move(ways), decider_of(selector.origin));
  }

  // ---- conditions

  std::uint32_t branch(const StatementNode& statement) {
    const auto condition = program_.as<IfView>(statement);
    const auto* yes = &program_.statements[statement.then_branch];
    const auto* no =
        statement.else_branch == none ? nullptr : &program_.statements[statement.else_branch];
    const auto holds = truth(condition);
    if (stopped_)
      return none;
    if (holds)
      return take(*holds ? yes : no);
    const bool meet = goes_on(*yes) && (no == nullptr || goes_on(*no));
    const auto origin = std::max(origin_of(condition.first),
                                 condition.second ? origin_of(*condition.second) : Origin::Program);
    const bool open = is_open(condition.first) &&
                      (!condition.second || is_open(*condition.second)) && !is_settled(origin);
    if (!open)
      return meet ? join_branches(condition, *yes, no) : join_ways(condition, *yes, no);
    const bool idle = meet && is_idle(*yes) && (no == nullptr || is_idle(*no));
    const auto here = now_;
    const auto span = span_of(condition);
    std::vector<Moment> ways;
    for (const auto answer : {Holds::Yes, Holds::No}) {
      now_ = here;
      stopped_ = false;
      if (!assume(condition, answer))
        continue;
      decide(now_, span,
             answer == Holds::Yes ? &texts::WhenThisHolds : &texts::WhenThisDoesNotHold);
      const auto to = take(answer == Holds::Yes ? yes : no);
      now_.at = stopped_ ? none : to;
      ways.push_back(std::move(now_));
    }
    now_ = here;
    stopped_ = false;
    if (idle)
      return line_ + 1;
    const auto decider = waits_for_time(statement) ? Decider::Clock : decider_of(origin);
    const auto next = part(std::move(ways), decider);
    if (next != none || probing_ || here.decision != none || runs_[line_] > most_joined)
      return next;
    now_ = here; // a fault here is certain, whatever the decision
    return meet ? join_branches(condition, *yes, no) : join_ways(condition, *yes, no);
  }

  static Decider decider_of(Origin origin) {
    return origin == Origin::Motion ? Decider::Program : Decider::World;
  }

  /// True if a condition depends only on timers.
  bool waits_for_time(const StatementNode& statement) const {
    bool timers = false;
    for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n) {
      const auto& node = program_.nodes[n];
      if (node.kind == NodeKind::Number || node.kind == NodeKind::Group)
        continue;
      if (node.kind != NodeKind::System || spec::variables[node.what].unit != "ms")
        return false;
      timers = true;
    }
    return timers;
  }

  static Span span_of(const IfView& condition) {
    return {condition.first.left.span.begin, condition.last().right.span.end};
  }

  std::uint32_t take(const StatementNode* branch) {
    return branch == nullptr ? line_ + 1 : step(*branch);
  }

  /// Joins both branches where both lead to the next line and either may be impossible.
  std::uint32_t join_branches(const IfView& condition, const StatementNode& yes,
                              const StatementNode* no) {
    const bool quiet = std::exchange(quiet_, true);
    auto otherwise = now_;
    const bool may_hold = assume(condition, Holds::Yes);
    if (may_hold)
      obey(yes);
    std::swap(now_, otherwise);
    const bool may_fail = assume(condition, Holds::No);
    if (may_fail && no != nullptr)
      obey(*no);
    if (!may_fail)
      now_ = std::move(otherwise);
    else if (may_hold)
      join_way(condition, otherwise);
    quiet_ = quiet;
    return line_ + 1;
  }

  /// The same where they lead to different lines: continues where both arrive soon.
  std::uint32_t join_ways(const IfView& condition, const StatementNode& yes,
                          const StatementNode* no) {
    if (probing_ || now_.decision != none)
      return none;
    const auto here = now_;
    const bool quiet = std::exchange(quiet_, true);
    std::vector<Moment> first;
    const auto start = [&](Holds answer, const StatementNode* branch) {
      now_ = here;
      now_.at = assume(condition, answer) ? take(branch) : none;
      return std::exchange(now_, here);
    };
    probe(start(Holds::Yes, &yes), most_probed, [&] {
      first.push_back(now_);
      return true;
    });
    std::optional<Moment> meeting;
    probe(start(Holds::No, no), most_probed, [&] {
      const auto same = std::find_if(first.begin(), first.end(), [&](const Moment& one) {
        return one.at == now_.at && one.loops == now_.loops && one.calls == now_.calls;
      });
      if (same == first.end())
        return true;
      join_way(condition, *same);
      meeting = now_;
      return false;
    });
    quiet_ = quiet;
    if (!meeting)
      return none;
    now_ = *std::move(meeting);
    return now_.at;
  }

  /// Joins another path. What differs depends on the condition, which no later line may decide.
  void join_way(const IfView& condition, const Moment& other) {
    if (now_.is_like(other))
      return;
    join_into(now_, other);
    bind(condition.first.left);
    bind(condition.first.right);
    if (condition.second) {
      bind(condition.second->left);
      bind(condition.second->right);
    }
  }

  /// True if the statement always falls through.
  static bool goes_on(const StatementNode& statement) {
    const auto after = spec::info(statement.kind).after;
    return !statement.error && (after == spec::After::Falls || after == spec::After::Waits);
  }

  /// True if a statement leaves the state unchanged.
  static bool is_idle(const StatementNode& statement) {
    const auto form = spec::info(statement.kind).form;
    return form == spec::Form::Output ||
           (form == spec::Form::Arguments && statement.kind != spec::Statement::Rstr);
  }

  std::optional<bool> truth(const IfView& condition) {
    const auto first = truth(condition.first);
    if (condition.joint == nullptr)
      return first;
    const bool quiet = std::exchange(quiet_, true); // the second comparison may be skipped
    const auto second = truth(*condition.second);
    quiet_ = quiet;
    const bool decides = condition.joint->kind == ItemKind::Or; // one such result decides
    if (first == decides || second == decides)
      return decides;
    return first && second ? std::optional(!decides) : std::nullopt;
  }

  std::optional<bool> truth(const Comparison& comparison) {
    const auto left = value(comparison.left).range;
    return answer_of(orders_of(comparison), left, value(comparison.right).range);
  }

  /// True if the comparison just computed can go both ways, or its result is known.
  bool is_open(const Comparison& comparison) const {
    const auto orders = orders_of(comparison);
    const auto& left = known_[comparison.left.value];
    const auto& right = known_[comparison.right.value];
    if (answer_of(orders, left.range, right.range))
      return true;
    if (left.ties == Ties::Shared || right.ties == Ties::Shared)
      return false;
    const bool equals = orders == Orders::Equal || orders == Orders::NotEqual;
    return equals ? left.dense && right.dense : left.exact && right.exact;
  }

  Origin origin_of(const Comparison& comparison) const {
    return std::max(known_[comparison.left.value].origin, known_[comparison.right.value].origin);
  }

  /// True if a value caused by the program has already decided at this line on this path. It is
  /// unknown how often it can do so.
  bool is_settled(Origin origin) const {
    return origin == Origin::Motion &&
           std::find(now_.driven.begin(), now_.driven.end(), line_) != now_.driven.end();
  }

  /// Narrows the operands to where the condition holds or not; returns false if that is impossible.
  bool assume(const IfView& condition, Holds holds) {
    static_cast<void>(truth(condition)); // sets known_ to what holds on this path
    if (condition.joint == nullptr)
      return assume(condition.first, holds);
    if ((condition.joint->kind == ItemKind::And) != (holds == Holds::Yes)) { // either of the two
      for (const auto* side : {&condition.first, &*condition.second}) {
        blur(side->left);
        blur(side->right);
      }
      return true;
    }
    if (!assume(condition.first, holds))
      return false;
    const bool quiet = std::exchange(quiet_, true);
    static_cast<void>(truth(*condition.second));
    quiet_ = quiet;
    return assume(*condition.second, holds);
  }

  bool assume(const Comparison& comparison, Holds holds) {
    const auto orders = orders_of(comparison, holds);
    const auto left = known_[comparison.left.value].range;
    const auto right = known_[comparison.right.value].range;
    const auto left_where = where(orders, left, right);
    const auto right_where = where(mirrored(orders), right, left);
    if (!left_where || !right_where)
      return false;
    narrow(comparison.left, *left_where);
    narrow(comparison.right, *right_where);
    if (!left.constant() && !right.constant()) {
      blur(comparison.left);
      blur(comparison.right);
    }
    // Excluding an inner value leaves a gap.
    if (orders == Orders::NotEqual && *left_where == left)
      for (const auto* side : {&comparison.left, &comparison.right})
        if (auto* const one = variable_of(bare(program_, *side)))
          one->dense = one->range.constant();
    return true;
  }

  /// Forgets which ends of their ranges the variables take that depend on each other: a test has
  /// told something of one of them.
  static void blur_tied(Moment& way) {
    for (auto* all : {&way.letters, &way.elements})
      for (auto& one : *all)
        if (one.ties != Ties::None && !one.range.constant())
          one.exact = one.dense = false;
  }

  void narrow(const Item& side, const Range& to) {
    auto* const variable = variable_of(bare(program_, side));
    if (variable == nullptr) {
      blur(side);
      if (known_[side.value].ties != Ties::None)
        blur_tied(now_);
      return;
    }
    auto& value = *variable;
    const auto known = value;
    if (value.ties != Ties::None)
      blur_tied(now_);
    value = known;
    if (value.range == to)
      return;
    value.range = to;
    value.exact = value.dense = value.dense || to.constant();
  }

  // ---- loops that never end

  /// A test in a loop, and all values that its letter has there.
  struct Tested {
    std::uint32_t line = 0;
    Range range;
  };

  /// Reports a loop on the only path that the program never leaves, at its last test that would
  /// leave it. Loops without such a test are meant to be endless.
  void note_endless() {
    if (now_.decision != none)
      return;
    const auto begin = now_;
    auto first = begin.at;
    auto last = begin.at;
    std::vector<Tested> tests;
    bool begun = false;
    bool closed = false;
    probe(begin, most_cycle, [&] {
      closed = std::exchange(begun, true) && now_.is_like(begin);
      if (!closed && now_.calls.size() <= begin.calls.size()) { // not in a subroutine
        first = std::min(first, now_.at);
        last = std::max(last, now_.at);
        note_test(tests);
      }
      return !closed;
    });
    const Tested* last_exit = nullptr;
    for (const auto& test : tests)
      if (closed && leaves(test.line, first, last) &&
          (last_exit == nullptr || test.line > last_exit->line))
        last_exit = &test;
    if (last_exit != nullptr)
      add_endless(*last_exit);
  }

  /// Adds what the test of a letter on this line sees.
  void note_test(std::vector<Tested>& tests) const {
    const auto& statement = program_.statements[flow_.code[now_.at].statement];
    if (statement.error || statement.kind != spec::Statement::If)
      return;
    const auto letter = letter_in(program_, program_.as<IfView>(statement).first.left);
    if (!letter)
      return;
    const auto& range = now_.letters[*letter].range;
    const auto known = std::find_if(tests.begin(), tests.end(),
                                    [&](const Tested& one) { return one.line == now_.at; });
    if (known == tests.end())
      tests.push_back({now_.at, range});
    else
      known->range = join(known->range, range);
  }

  /// True if a test may lead to a line outside of a loop, or end the program.
  bool leaves(std::uint32_t test, std::uint32_t first, std::uint32_t last) const {
    const auto& code = flow_.code[test];
    const auto jumps = flow_.jumps_of(code);
    const auto outside = [&](std::uint32_t line) { return line < first || line > last; };
    return code.ends || (code.falls && outside(test + 1)) ||
           std::any_of(jumps.begin(), jumps.end(),
                       [&](const auto& way) { return !way.call && outside(way.to); });
  }

  void add_endless(const Tested& test) {
    const auto& value = test.range;
    const auto condition =
        program_.as<IfView>(program_.statements[flow_.code[test.line].statement]);
    if (condition.second)
      return;
    const auto name = program_.text_of(condition.first.left.span);
    add({&rules::EndlessLoop, span_of(condition),
         value.constant() ? texts::StaysTheSame(name, value.lo) : texts::RoundsRepeat(name),
         value.constant() ? texts::ChangeOnEveryWay(name) : Message(), none, true, false});
  }

  // ---- ways

  void decide(Moment& way, Span span = {}, const orb::Text* when = nullptr) {
    trial_.decisions.push_back({span, when, way.decision});
    way.decision = static_cast<std::uint32_t>(trial_.decisions.size() - 1);
  }

  /// Continues on each path, except on those that return here with the state unchanged: there the
  /// program waits for another path. When waiting for a timer, that path is certain. Paths that
  /// soon meet are merged.
  std::uint32_t part(std::vector<Moment> ways, Decider decider) {
    if (probing_ || !parts_anew())
      return none;
    const auto waits = std::erase_if(ways, [&](const Moment& way) { return comes_back(way); });
    if (waits > 0 && ways.size() == 1) {
      auto& only = ways.front();
      if (decider == Decider::Clock) {
        for (auto& fault : trial_.faults)
          if (fault.decision == only.decision)
            fault.decision = now_.decision;
        only.decision = now_.decision;
      }
      now_ = std::move(only);
      return now_.at;
    }
    if (auto meeting = meeting_of(ways)) {
      meeting->decision = now_.decision;
      now_ = std::move(*meeting);
      return now_.at;
    }
    for (auto& way : ways) {
      if (way.at == none || ways_.size() == most_ways)
        continue;
      if (decider != Decider::World)
        way.driven.push_back(line_);
      ways_.push_back(std::move(way));
    }
    return none;
  }

  /// Follows a path for so many lines at most, while it does not split and `goes_on` returns true,
  /// without reporting faults.
  void probe(const Moment& way, std::uint32_t most, const std::function<bool()>& goes_on) {
    const auto here = std::exchange(now_, way);
    const auto line = line_;
    probing_ = true;
    for (std::uint32_t n = 0; n < most && now_.at < flow_.code.size() && goes_on(); ++n)
      go();
    probing_ = false;
    stopped_ = false;
    line_ = line;
    now_ = here;
  }

  bool comes_back(const Moment& way) {
    const auto here = now_;
    bool same = false;
    probe(way, most_probed, [&] {
      same = now_.at == here.at && now_.is_like(here);
      return now_.at != here.at;
    });
    return same;
  }

  /// Finds a state that all paths reach.
  std::optional<Moment> meeting_of(const std::vector<Moment>& ways) {
    std::optional<Moment> meeting;
    if (ways.size() < 2)
      return meeting;
    std::vector<std::uint64_t> places; // states of the first path
    probe(ways.front(), most_probed, [&] {
      places.push_back(now_.hash());
      return true;
    });
    for (std::size_t i = 1; i < ways.size(); ++i) {
      std::optional<Moment> found;
      probe(ways[i], most_probed, [&] {
        const auto at = std::find(places.begin(), places.end(), now_.hash());
        if (at == places.end())
          return true;
        places.erase(places.begin(), at); // the other paths must meet here or later
        found = now_;
        return false;
      });
      if (!found)
        return std::nullopt;
      meeting = std::move(found);
    }
    return meeting;
  }

  std::deque<Moment> ways_;                  ///< paths still to follow
  std::uint32_t lines_ = 0;                  ///< lines executed
  std::unordered_set<std::uint64_t> met_;    ///< hashes of states that a path returned to
  std::unordered_set<std::uint64_t> parted_; ///< hashes of states at which paths split
};

} // namespace

Trial try_program(const Program& program, const Flow& flow) {
  return TrialRun(program, flow).run();
}

} // namespace orb::compiler
