#include "base/text/text.h"
#include "compiler/lint/line_pass.h"

#include "compiler/analyse/letter_flow.h"
#include "compiler/text/rules.h"
#include "spec/colours.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::compiler {
namespace {

using spec::Statement;

/// The lasting effect of a statement until the next one of its kind.
enum class Shows : std::uint8_t { Nothing, Colour, BackLed, Roll };

Shows shows(Statement kind) {
  if (kind == Statement::Rgb || kind == Statement::Ledc)
    return Shows::Colour;
  if (kind == Statement::BackLed)
    return Shows::BackLed;
  return kind == Statement::Goroll ? Shows::Roll : Shows::Nothing;
}

/// The messages for each effect.
struct ShowsTexts {
  const Row<>& never_seen;
  const Row<>& only_last;
  const Row<>& next;
};
ShowsTexts texts_of(Shows what) {
  if (what == Shows::Colour)
    return {texts::ColourNeverSeen, texts::OnlyLastColour, texts::NextColour};
  if (what == Shows::Roll)
    return {texts::RollNeverSeen, texts::OnlyLastRoll, texts::NextRoll};
  return {texts::LightNeverSeen, texts::OnlyLastColour, texts::NextLight};
}

/// True if the statement may drive, colour or stop the ball in an unknown way.
bool is_foreign_hand(Statement kind) {
  return kind == Statement::Raw || kind == Statement::Macrun || kind == Statement::Mackill;
}

/// The motion of the ball at a line, over all paths.
struct Motion {
  enum class Kind : std::uint8_t {
    Unreached,
    Rests,
    Drives, ///< after `roll`
    Coasts, ///< after `roll` with speed 0 while driving: it rolls on without braking
    Unknown,
  };
  Kind kind = Kind::Unreached;
  std::uint32_t roll = none; ///< the line of code

  friend bool operator==(Motion, Motion) = default;
};

Motion join(Motion a, Motion b) {
  if (a.kind == Motion::Kind::Unreached || a == b)
    return b;
  if (b.kind == Motion::Kind::Unreached || a.kind == b.kind)
    return a;
  return {Motion::Kind::Unknown};
}

/// Finds programs that run without an error but not as intended: colours and rolls that nobody can
/// see, a ball that is left driving. Large because it makes three searches: for what is never seen,
/// what drives on, and what grows without limit.
class EffectsPass : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    for (const auto kind : {Statement::Rgb, Statement::Ledc, Statement::BackLed, Statement::Goroll})
      for (const auto& place : flow_.all(kind))
        if (flow_.is_line(place))
          check_shown(program_.statements[place.statement], place.code);
    if (may_judge_motion())
      check_motion();
    check_growth();
  }

private:
  // ---- what is never seen

  /// What happens to a visible effect.
  struct Fate {
    enum class Kind : std::uint8_t { Seen, Replaced, Ends } kind = Kind::Seen;
    std::uint32_t at = none; ///< the line of code that replaces it
    bool round = false;      ///< after the `next` of a loop
  };

  /// A walk along the only path, up to a wait.
  struct Walk {
    Shows what;
    std::uint32_t from;
    std::vector<std::uint32_t> calls = {}; ///< enclosing calls
    std::uint32_t steps = 0;
    bool round = false;
  };

  Fate follow(Walk& walk, std::uint32_t at) const {
    constexpr std::uint32_t most_steps = 64;
    for (; walk.steps < most_steps; ++walk.steps) {
      if (at == none)
        return {};
      if (at == size_)
        return {Fate::Kind::Ends};
      const auto& statement = statement_of(at);
      if (statement.error)
        return {};
      if (shows(statement.kind) == walk.what)
        return {Fate::Kind::Replaced, at, walk.round};
      if (is_foreign_hand(statement.kind))
        return {};
      const auto& row = spec::info(statement.kind);
      const auto jumps = flow_.jumps_of(flow_.code[at]);
      if (row.after == spec::After::Falls || statement.kind == Statement::For) {
        ++at;
      } else if (statement.kind == Statement::Goto) {
        at = jumps.front().to;
      } else if (statement.kind == Statement::Gosub) {
        walk.calls.push_back(at);
        at = jumps.front().to;
      } else if (statement.kind == Statement::Return) {
        if (walk.calls.empty())
          return follow_callers(walk, at);
        at = walk.calls.back() + 1;
        walk.calls.pop_back();
      } else if (statement.kind == Statement::Next && !walk.round) {
        walk.round = true;
        at = body_of(at);
      } else if (statement.kind == Statement::If && walk.what != Shows::Roll) {
        return follow_branches(walk, at);
      } else {
        return {statement.kind == Statement::End ? Fate::Kind::Ends : Fate::Kind::Seen};
      }
    }
    return {};
  }

  /// A light is replaced if both branches replace it.
  Fate follow_branches(const Walk& walk, std::uint32_t at) const {
    const auto& statement = statement_of(at);
    Fate fate;
    for (const auto branch : {statement.then_branch, statement.else_branch}) {
      auto on = walk;
      on.steps += 8;
      fate =
          branch == none ? follow(on, at + 1) : follow_branch(on, at, program_.statements[branch]);
      if (fate.kind != Fate::Kind::Replaced)
        return {};
    }
    return fate;
  }

  Fate follow_branch(Walk& walk, std::uint32_t at, const StatementNode& branch) const {
    if (branch.error || is_foreign_hand(branch.kind))
      return {};
    if (shows(branch.kind) == walk.what)
      return {Fate::Kind::Replaced, at, walk.round};
    if (spec::info(branch.kind).after == spec::After::Falls)
      return follow(walk, at + 1);
    if (branch.kind == Statement::Goto)
      for (const auto& jump : flow_.jumps_of(flow_.code[at]))
        if (jump.item == branch.items_begin && jump.to != none &&
            jump.to > at) // no loop that waits
          return follow(walk, jump.to);
    return {};
  }

  /// The callers continue with the last effect of a subroutine.
  Fate follow_callers(const Walk& walk, std::uint32_t last) const {
    const auto callers = callers_of(last);
    Fate fate;
    for (const auto caller : callers) {
      auto on = walk;
      on.steps += 8;
      fate = follow(on, caller + 1);
      if (fate.kind != Fate::Kind::Replaced)
        return {};
    }
    return fate;
  }

  /// The callers of the straight run of lines that ends at `last`; empty if there are many.
  std::vector<std::uint32_t> callers_of(std::uint32_t last) const {
    constexpr std::size_t many = 4;
    constexpr std::uint32_t longest = 64;
    auto entry = last;
    while (entry > 0 && last - entry < longest && !flow_.code[entry].called &&
           flow_.code[entry - 1].falls)
      --entry;
    std::vector<std::uint32_t> callers;
    if (!flow_.code[entry].called)
      return callers;
    for (const auto& jump : flow_.jumps)
      if (jump.call && jump.to == entry) {
        if (callers.size() == many || statement_of(jump.from).kind != Statement::Gosub)
          return {};
        callers.push_back(jump.from);
      }
    return callers;
  }

  /// The first line of the loop body for a `next`, in text order.
  std::uint32_t body_of(std::uint32_t next) const {
    const auto& variable = program_.as<NextView>(statement_of(next)).variable;
    for (auto i = next; i > 0; --i) {
      const auto& statement = statement_of(i - 1);
      if (!statement.error && statement.kind == Statement::For &&
          program_.as<ForView>(statement).variable.value == variable.value)
        return i;
    }
    return none;
  }

  void check_shown(const StatementNode& statement, std::uint32_t code) {
    const auto what = shows(statement.kind);
    if (!flow_.code[code].falls)
      return;
    Walk walk{what, code};
    const auto fate = follow(walk, code + 1);
    if (fate.kind == Fate::Kind::Ends && what == Shows::Colour && is_light(statement) &&
        is_only_colour(statement))
      findings_.add(rules::MissingDelay, statement.span, texts::ColourAtTheEnd(),
                    texts::AddBelowIt("delay 1000"));
    if (fate.kind != Fate::Kind::Replaced || (fate.at == code && !fate.round))
      return;
    const auto& next = statement_of(fate.at);
    if (fate.at == code) {
      if (what != Shows::BackLed)
        findings_.add(rules::MissingDelay, statement.span, texts_of(what).only_last(),
                      texts::AddBelowThisLine("delay 50"));
      return;
    }
    if (what == Shows::Roll && (fate.round || fate.at < code))
      return; // steering rolls replace each other, and turns come before them
    const auto unseen = texts_of(what).never_seen();
    auto& d = fate.round || fate.at < code
                  ? findings_.add(rules::MissingDelay, statement.span,
                                  texts::InNextIteration(unseen), texts::AddBelowIt("delay 500"))
                  : findings_.add(rules::MissingDelay, statement.span, unseen,
                                  texts::AddBetween("delay 500"));
    add_note(d, next.span, texts_of(what).next());
  }

  /// Another colour at the end is a sign-off. If it is the only colour of a program that takes some
  /// time, it is never seen.
  bool is_only_colour(const StatementNode& colour) const {
    return std::any_of(flow_.code.begin(), flow_.code.end(),
                       [](const Flow::Code& code) { return code.waits; }) &&
           std::all_of(program_.statements.begin(), program_.statements.end(),
                       [&](const StatementNode& other) {
                         return other.error || &other == &colour ||
                                shows(other.kind) != Shows::Colour;
                       });
  }

  /// True if a colour is given as literal numbers and is not black.
  bool is_light(const StatementNode& colour) const {
    const auto items = program_.items_of(colour);
    const auto is = [&](const Item& item) { return number_in(program_, item).has_value(); };
    const auto lights = [&](const Item& item) { return number_in(program_, item) != 0; };
    if (!std::all_of(items.begin(), items.end(), is) ||
        !std::any_of(items.begin(), items.end(), lights))
      return false;
    return colour.kind == Statement::Rgb ||
           number_in(program_, items[0]) != spec::led_colours.back().code;
  }

  // ---- what drives on

  /// True if a program with rolls ends somewhere, or has a braking roll with a speed.
  bool may_judge_motion() const {
    const auto rolls = flow_.all(Statement::Goroll);
    return std::any_of(rolls.begin(), rolls.end(),
                       [&](const Flow::Place& roll) { return flow_.is_line(roll); }) &&
           (flow_.code.back().falls || !flow_.all(Statement::End).empty() ||
            std::any_of(rolls.begin(), rolls.end(), [&](const Flow::Place& roll) {
              return brakes_with_speed(program_.statements[roll.statement]);
            }));
  }

  bool brakes_with_speed(const StatementNode& roll) const {
    const auto items = program_.items_of(roll);
    return items.size() == 3 && number_in(program_, items[2]) == 0 &&
           number_in(program_, items[1]).value_or(0) > 0;
  }

  /// Propagates the motion of the ball along all paths.
  void check_motion() {
    find_settled();
    motion_.assign(size_, {});
    reach(0, {Motion::Kind::Rests});
    while (!waiting_.empty()) {
      const auto at = waiting_.back();
      waiting_.pop_back();
      go_on(at);
    }
    for (std::uint32_t i = 0; i < size_; ++i)
      judge(i);
    if (size_ > 0 && end_.kind != Motion::Kind::Unreached)
      judge_end(end_, statement_of(size_ - 1).span);
  }

  void reach(std::uint32_t code, Motion motion) {
    if (code == none)
      return;
    auto& known = code == size_ ? end_ : motion_[code];
    const auto joined = join(known, motion);
    if (joined == known)
      return;
    known = joined;
    if (code < size_)
      waiting_.push_back(code);
  }

  void go_on(std::uint32_t at) {
    const auto& code = flow_.code[at];
    const auto before = motion_[at];
    const auto& statement = statement_of(at);
    auto after = step(statement, before, at);
    bool calls = false;
    for (const auto& jump : flow_.jumps_of(code)) {
      reach(jump.to, after);
      calls = calls || jump.call;
    }
    if (statement.kind == Statement::Next)
      reach(body_of(at), after);
    for (const auto& branch : program_.whole(statement).subspan(1))
      after = join(after, step(branch, before, at));
    if (code.falls)
      reach(at + 1, calls ? Motion{Motion::Kind::Unknown} : after);
  }

  /// The literal number, or the only number assigned to the letter.
  std::optional<std::int32_t> number_of(const Item& item) const {
    const auto letter = letter_in(program_, item);
    return letter ? settled_[*letter] : number_in(program_, item);
  }

  /// Finds letters that are assigned once, to a number, on the straight path at the start of the
  /// program.
  void find_settled() {
    std::array<std::uint32_t, most_letters> sets{};
    for (const auto& item : program_.items)
      if (item.kind == ItemKind::Letter)
        ++sets[item.value];
    for (std::uint32_t i = 0; i < size_ && flow_.code[i].falls; ++i) {
      const auto& statement = statement_of(i);
      if (statement.error || !flow_.jumps_of(flow_.code[i]).empty() || flow_.code[i].loops)
        return;
      if (statement.kind != Statement::Let)
        continue;
      const auto let = program_.as<LetView>(statement);
      if (let.variable.kind == ItemKind::Letter && sets[let.variable.value] == 1)
        settled_[let.variable.value] = number_in(program_, let.expression);
    }
  }

  static Motion unknown() { return {Motion::Kind::Unknown}; }

  Motion step(const StatementNode& statement, Motion before, std::uint32_t at) const {
    if (statement.error || is_foreign_hand(statement.kind))
      return unknown();
    if (sets(statement, spec::Variable::Ctrl))
      return unknown();
    if (statement.kind != Statement::Goroll)
      return before;
    const auto items = program_.items_of(statement);
    const auto speed = number_of(items[1]);
    const auto go = items.size() < 3 ? speed : number_of(items[2]);
    if (speed && go && *speed > 0 && *go > 0)
      return {Motion::Kind::Drives, at};
    if (go == 0 ||
        (speed == 0 && before.kind != Motion::Kind::Drives && before.kind != Motion::Kind::Coasts))
      return go == 0 ? Motion{Motion::Kind::Rests} : before;
    return speed == 0 && go ? Motion{Motion::Kind::Coasts, at} : unknown();
  }

  void judge(std::uint32_t at) {
    const auto before = motion_[at];
    for (const auto& statement : program_.whole(statement_of(at))) {
      if (statement.error || before.kind == Motion::Kind::Unreached)
        return;
      if (statement.kind == Statement::End)
        judge_end(before, statement.span);
      if (statement.kind == Statement::Goroll && before.kind == Motion::Kind::Rests)
        judge_start(statement);
    }
  }

  void judge_end(Motion motion, Span where) {
    if (motion.kind == Motion::Kind::Drives) {
      auto& d = findings_.add(rules::DrivesOn, where, texts::EndsWhileDriving(),
                              texts::StopItFirst("goroll 0,0,0"));
      add_note(d, statement_of(motion.roll).span, texts::StartsDrivingHere());
      add_stop(motion.roll, where, d);
    }
    if (motion.kind == Motion::Kind::Coasts)
      add_go(rules::WeakBrake, statement_of(motion.roll), texts::LetsBallCoast(), '0');
  }

  /// The only `delay` below a roll, if no jump occurs before the end.
  std::optional<std::uint32_t> only_wait_below(std::uint32_t roll) const {
    std::optional<std::uint32_t> found;
    for (auto i = roll + 1; i < size_; ++i) {
      const auto& statement = statement_of(i);
      if (flow_.code[i].target || statement.error || statement.then_branch != none ||
          flow_.code[i].loops || !flow_.jumps_of(flow_.code[i]).empty() ||
          (found && statement.kind == Statement::Delay))
        return std::nullopt;
      if (statement.kind == Statement::Delay)
        found = i;
    }
    return found;
  }

  /// Proposes a line that stops the ball in its rolling direction: above an `end`, or as the last
  /// line.
  void add_stop(std::uint32_t roll, Span where, Diagnostic& d) const {
    if (const auto wait = only_wait_below(roll))
      where = statement_of(*wait).span;
    const auto& heading = program_.items_of(statement_of(roll))[0];
    const auto stop = fmt::format(
        "goroll {},0,0", number_in(program_, heading) ? program_.text_of(heading.span) : "0");
    const auto line =
        std::find_if(program_.lines.begin(), program_.lines.end(), [&](const Line& one) {
          return one.span.begin <= where.begin && where.end <= one.span.end;
        });
    if (line == program_.lines.end() || !line->has_number() || !line->has_statement() ||
        program_.statements[line->statement].span != where)
      return; // in a branch of an `if`
    const bool ends = program_.statements[line->statement].kind == Statement::End;
    const auto below = std::find_if(line + 1, program_.lines.end(),
                                    [](const Line& one) { return one.has_number(); });
    const auto above = std::find_if(std::make_reverse_iterator(line), program_.lines.rend(),
                                    [](const Line& one) { return one.has_number(); });
    constexpr std::uint32_t step = 10;
    const auto from = !ends ? line->number : above == program_.lines.rend() ? 0 : above->number;
    const bool waits = std::any_of(flow_.code.begin(), flow_.code.end(),
                                   [](const Flow::Code& code) { return code.waits; });
    const std::uint32_t parts = waits ? 2 : 3; // without a wait, the fix adds one
    const auto to = ends                            ? line->number
                    : below != program_.lines.end() ? below->number
                                                    : line->number + parts * step;
    if (to < from + parts ||
        to > static_cast<std::uint32_t>(spec::value_of(spec::Limit::GreatestLineNumber)))
      return;
    const auto end = std::string(line_end_of(program_.text));
    auto text = fmt::format("{} {}", from + (to - from) / parts * (parts - 1), stop);
    d.help = texts::Add(text);
    if (!waits) {
      const auto wait = fmt::format("{} delay 1000", from + (to - from) / parts);
      d.help = texts::AddTwo(wait, text);
      text = wait + end + text;
    }
    d.fix =
        ends ? single_fix(d.help, {line->span.begin, line->span.begin}, text + end, Safety::Unsafe)
             : single_fix(d.help, {line->span.end, line->span.end}, end + text, Safety::Unsafe);
  }

  void judge_start(const StatementNode& roll) {
    if (brakes_with_speed(roll))
      add_go(rules::GoZero, roll,
             texts::GoZeroBrakes(*number_in(program_, program_.items_of(roll)[1])), '1');
  }

  void add_go(const Rule& rule, const StatementNode& roll, Message message, char go) {
    const auto& item = program_.items_of(roll).back();
    const auto line = std::string(program_.text_of({roll.span.begin, item.span.begin})) + go;
    auto& d = findings_.add(rule, item.span, std::move(message), texts::Write(line));
    d.fix = single_fix(d.help, item.span, std::string(1, go), Safety::Unsafe);
  }

  // ---- what grows

  static bool is(const Node& root, spec::Operator sign) {
    return root.kind == NodeKind::Binary && static_cast<spec::Operator>(root.what) == sign;
  }
  static bool is_sum(const Node& root) { return is(root, spec::Operator::Add); }
  static bool is_difference(const Node& root) { return is(root, spec::Operator::Subtract); }

  /// The amount that a line adds to its own letter, negative if it subtracts: `A = A + 1`.
  std::optional<std::int32_t> growth_by(const LetView& let) const {
    const auto nodes = nodes_of(program_, let.expression);
    if (nodes.size() != 3 || (!is_sum(nodes[2]) && !is_difference(nodes[2])) ||
        let.variable.kind != ItemKind::Letter || nodes[0].kind != NodeKind::Letter ||
        nodes[0].what != let.variable.value || nodes[1].kind != NodeKind::Number ||
        nodes[1].value <= 0)
      return std::nullopt;
    return is_sum(nodes[2]) ? nodes[1].value : -nodes[1].value;
  }

  /// The letters that a line adds to.
  LetterSet growing_letters() const {
    LetterSet grown = 0;
    for (const auto& place : flow_.all(Statement::Let))
      if (flow_.is_line(place))
        if (const auto let = program_.as<LetView>(program_.statements[place.statement]);
            growth_by(let))
          grown |= bit(let.variable.value);
    return grown;
  }

  struct Growth {
    std::uint32_t code = none;         ///< the line that adds to the letter; none if there is none
    const Item* sum = nullptr;         ///< the expression assigned there
    std::int32_t step = 0;             ///< the amount added; negative: subtracted
    std::vector<std::uint32_t> resets; ///< lines that assign a number to it
    bool bounded = false;              ///< it is tested, or assigned in another way
  };
  /// A letter used alone as an argument.
  struct Given {
    std::uint32_t letter;
    std::uint32_t code;
    const spec::StatementInfo* row;
    const spec::Parameter* parameter;
  };

  /// The places where one of these letters is an argument of a whole-line statement.
  std::vector<Given> places_given(LetterSet letters) const {
    std::vector<Given> all;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& statement = statement_of(i);
      const auto& row = spec::info(statement.kind);
      if (statement.error || row.form != spec::Form::Arguments)
        continue;
      const auto items = program_.items_of(statement);
      for (std::size_t n = 0; n < items.size(); ++n)
        if (const auto letter = letter_in(program_, items[n]);
            letter && (letters & bit(*letter)) != 0)
          all.push_back({*letter, i, &row, &row.parameter_slots[n]});
    }
    return all;
  }

  /// Finds endless loops that add to an argument and never test it.
  void check_growth() {
    const auto letters = growing_letters();
    if (letters == 0)
      return;
    const auto all_given = places_given(letters);
    std::array<Growth, most_letters> growth;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto whole = program_.whole(program_.statements[flow_.code[i].statement]);
      for (const auto& statement : whole)
        if (!statement.error)
          read_growth(statement, i, whole.size() > 1, growth);
    }
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& statement = program_.statements[flow_.code[i].statement];
      if (statement.error || statement.kind != Statement::Goto)
        continue;
      const auto to = flow_.jumps[flow_.code[i].jumps_begin].to;
      const auto within = [&](std::uint32_t code) { return to <= code && code <= i; };
      for (const auto& given : all_given) {
        auto& grown = growth[given.letter];
        if (!within(given.code) || !within(grown.code) || grown.bounded ||
            std::any_of(grown.resets.begin(), grown.resets.end(), within))
          continue;
        if (grown.step < 0 && given.parameter->unit != "deg")
          continue; // there is no line to propose for a value that becomes too small
        add_growth(grown, given);
        grown.bounded = true; // report once
      }
    }
  }

  void read_growth(const StatementNode& statement, std::uint32_t code, bool in_if,
                   std::array<Growth, most_letters>& growth) const {
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind == ItemKind::Letter)
        set_growth(statement, item.value, code, in_if, growth);
      if (in_if && item.kind == ItemKind::Expression)
        for (auto n = program_.nodes[item.value].first; n <= item.value; ++n)
          if (program_.nodes[n].kind == NodeKind::Letter)
            growth[program_.nodes[n].what].bounded = true;
    }
  }

  void set_growth(const StatementNode& statement, std::uint32_t letter, std::uint32_t code,
                  bool in_if, std::array<Growth, most_letters>& growth) const {
    auto& grown = growth[letter];
    if (statement.kind != Statement::Let || in_if) {
      grown.bounded = true;
      return;
    }
    const auto let = program_.as<LetView>(statement);
    if (program_.nodes[let.expression.value].kind == NodeKind::Number) {
      grown.resets.push_back(code);
      return;
    }
    const auto step = growth_by(let);
    if (step && grown.code == none) {
      grown.code = code;
      grown.sum = &let.expression;
      grown.step = *step;
    } else {
      grown.bounded = true;
    }
  }

  void add_growth(const Growth& grown, const Given& given) {
    const auto& sum = *grown.sum;
    const auto letter = spec::letter_name(given.letter);
    const auto turn = given.parameter->greatest + 1;
    const bool heading = given.parameter->unit == "deg";
    // The remainder of a negative value is negative, so add a turn first.
    const auto inner = grown.step > 0 ? std::string(program_.text_of(sum.span))
                                      : fmt::format("{} + {}", letter, turn + grown.step % turn);
    const auto bounded = fmt::format("({}) % {}", inner, turn);
    auto& d =
        findings_.add(heading ? rules::HeadingGrows : rules::ValueGrows, sum.span,
                      !heading ? texts::ValueGrowing(letter, texts::of_table(given.parameter->name),
                                                     given.row->word, turn - 1)
                      : grown.step > 0 ? texts::HeadingGrowing(letter, turn - 1)
                                       : texts::HeadingShrinking(letter),
                      texts::Write(bounded));
    d.fix = single_fix(d.help, sum.span, bounded, Safety::Unsafe);
  }

  std::array<std::optional<std::int32_t>, most_letters> settled_{}; ///< letters with a constant
                                                                    ///< value
  std::vector<Motion> motion_; ///< state before each line of code
  Motion end_;                 ///< below the last line
  std::vector<std::uint32_t> waiting_;
};

} // namespace

void lint_effects(const Program& program, const Flow& flow, Findings& findings) {
  EffectsPass(program, flow, findings).run();
}

} // namespace orb::compiler
