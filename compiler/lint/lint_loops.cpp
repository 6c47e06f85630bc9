#include "compiler/analyse/letter_flow.h"
#include "compiler/lint/line_pass.h"

#include "compiler/text/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace orb::compiler {
namespace {

constexpr std::uint32_t indexed = most_letters - 1; // stands for Z in masks and stacks of loop
                                                    // variables

std::uint32_t variable_of(const Item& item) {
  return item.kind == ItemKind::Letter ? item.value : indexed;
}

bool is(const StatementNode& node, spec::Statement kind) {
  return !node.error && node.kind == kind;
}

/// The loops that are open before a line on every path. Packed into one number, because it is
/// copied and compared more often than read.
class Loops {
public:
  static constexpr std::uint32_t most = spec::value_of(spec::Limit::ForDepth);

  static Loops unknown() {
    Loops loops;
    loops.bits_ = UINT64_MAX;
    return loops;
  }
  bool known() const { return bits_ != UINT64_MAX; }
  std::uint32_t count() const { return bits_ & UINT8_MAX; }
  std::uint32_t innermost() const { return variables() & UINT8_MAX; }
  void open(std::uint32_t variable) { bits_ = (variables() << 8 | variable) << 8 | (count() + 1); }
  void close() { bits_ = variables() >> 8 << 8 | (count() - 1); }
  friend bool operator==(Loops, Loops) = default;

private:
  std::uint64_t variables() const { return bits_ >> 8; }

  /// The number of loops in the lowest byte, then a byte per loop variable, innermost first.
  std::uint64_t bits_ = 0;
  static_assert(most < sizeof bits_);
};

/// The effect of a line on the open loops.
enum class Effect : std::uint8_t {
  Nothing,
  Opens,
  Closes,
  Unsure, ///< a `for` or `next` in a branch, which may or may not run
};

/// A line that does more than fall through with the same loops open.
struct Part {
  std::uint32_t code = 0;
  Effect effect = Effect::Nothing;
  bool returns = false;           ///< has a `return`
  std::uint32_t variable = 0;     ///< the variable of the loop that it opens or closes
  std::uint32_t innermost = none; ///< the enclosing pair, in text order
  std::uint32_t first_state = none;
};

/// The main program, or a subroutine called with these loops open.
struct Call {
  std::uint32_t entry = 0; ///< a line of code
  Loops loops;
  std::uint32_t from = none;      ///< the first line of code with this call
  std::uint32_t from_call = none; ///< the call in which that line runs
  std::optional<Loops> returned;  ///< loops left open by its `return`s
  std::uint32_t first_waiting = none;
  std::uint32_t last_waiting = none;
};

/// A state that resumes when a call returns.
struct Waiting {
  std::uint32_t state;
  std::uint32_t next; ///< the next one of the same call
};

/// The state of a part within a call.
struct PartState {
  std::uint32_t part = 0;
  std::uint32_t call = 0;
  std::uint32_t next = none; ///< the next state of the same part
  Loops loops;
};

/// Finds each `for` and `next` that do not belong together. Large because it looks twice, in text
/// order and along all paths.
class LoopRules : private LinePass {
public:
  using LinePass::LinePass;

  void run() {
    if (nest_in_text())
      return; // and run as written
    collect_parts();
    match_pairs();
    check_jumps();
    check_unended();
    follow();
    for (const auto& part : parts_)
      report(part);
  }

private:
  std::uint32_t counter_of(const StatementNode& node) const {
    return variable_of(program_.as<ForView>(node).variable);
  }
  std::uint32_t stepped_by(const StatementNode& node) const {
    return variable_of(program_.as<NextView>(node).variable);
  }

  /// True if loops nest properly and no jump, call or return crosses a loop boundary.
  bool nest_in_text() const {
    const auto returns = flow_.all(spec::Statement::Return);
    std::vector<std::uint32_t> around; // by line of code: the `for` of the innermost loop
    return find_loops(around) &&
           std::all_of(flow_.jumps.begin(), flow_.jumps.end(),
                       [&](const Flow::Jump& jump) {
                         return jump.to == none || (around[jump.from] == around[jump.to] &&
                                                    !(jump.call && around[jump.from] != none));
                       }) &&
           std::all_of(returns.begin(), returns.end(),
                       [&](const Flow::Place& place) { return around[place.code] == none; });
  }

  /// Returns false if loops do not nest.
  bool find_loops(std::vector<std::uint32_t>& around) const {
    std::array<std::uint32_t, Loops::most> open{}; // the loops around an open loop
    std::size_t count = 0;
    auto innermost = none;
    around.assign(size_, none);
    for (std::uint32_t i = 0; i < size_; ++i) {
      around[i] = innermost;
      if (!flow_.code[i].loops)
        continue;
      const auto& node = statement_of(i);
      const auto variable = innermost == none ? none : counter_of(statement_of(innermost));
      if (node.kind == spec::Statement::For && count < open.size() &&
          counter_of(node) != variable) {
        open[count++] = std::exchange(innermost, i);
      } else if (node.kind == spec::Statement::Next && stepped_by(node) == variable) {
        innermost = open[--count];
      } else {
        return false;
      }
    }
    return innermost == none;
  }

  void collect_parts() {
    ahead_.resize(size_);
    parts_.reserve(size_);
    std::uint32_t first_plain = 0;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& code = flow_.code[i];
      const bool leads_on = code.falls && code.jumps_begin == code.jumps_end && !code.loops;
      if (leads_on && !code.ends)
        continue;
      auto& part = parts_.emplace_back();
      part.code = i;
      read(part);
      if (leads_on && !part.returns) { // an end in a branch ends the program
        parts_.pop_back();
        continue;
      }
      std::fill(ahead_.begin() + first_plain, ahead_.begin() + i + 1,
                static_cast<std::uint32_t>(parts_.size() - 1));
      first_plain = i + 1;
    }
    std::fill(ahead_.begin() + first_plain, ahead_.end(), none);
  }

  void read(Part& part) {
    const auto all = whole(part.code);
    for (const auto& node : all) {
      if (is(node, spec::Statement::Return)) {
        part.returns = true;
      } else if (is(node, spec::Statement::For)) {
        part.variable = counter_of(node);
        part.effect = all.size() > 1 ? Effect::Unsure : Effect::Opens;
        set_ |= bit(part.variable);
      } else if (is(node, spec::Statement::Next)) {
        part.variable = stepped_by(node);
        part.effect = all.size() > 1 ? Effect::Unsure : Effect::Closes;
        stepped_ |= bit(part.variable);
      }
    }
  }

  // ---- in text order

  struct LoopPair {
    std::uint32_t variable;
    std::uint32_t begin; ///< lines of code
    std::uint32_t end;
    std::uint32_t outer;
  };

  /// Pairs each `for` with its `next` in text order.
  void match_pairs() {
    std::vector<std::uint32_t> open;
    pairs_.reserve(parts_.size());
    for (auto& part : parts_) {
      if (part.effect == Effect::Opens) {
        const auto outer = open.empty() ? none : open.back();
        open.push_back(static_cast<std::uint32_t>(pairs_.size()));
        pairs_.push_back({part.variable, part.code, none, outer});
      }
      part.innermost = open.empty() ? none : open.back();
      const bool ends = part.effect == Effect::Closes &&
                        std::any_of(open.begin(), open.end(), [&](std::uint32_t pair) {
                          return pairs_[pair].variable == part.variable;
                        });
      if (!ends) // or it closes a loop that has been left
        continue;
      while (!open.empty() && pairs_[open.back()].variable != part.variable)
        open.pop_back();
      if (!open.empty()) {
        pairs_[open.back()].end = part.code;
        open.pop_back();
      }
    }
  }

  void check_jumps() {
    for (const auto& part : parts_) {
      const auto jumps = flow_.jumps_of(flow_.code[part.code]);
      auto pair = jumps.empty() ? none : part.innermost;
      while (pair != none && (pairs_[pair].end == none || part.code > pairs_[pair].end))
        pair = pairs_[pair].outer;
      if (pair == none)
        continue;
      for (const auto& jump : jumps)
        if (!jump.call && jump.to != none &&
            (jump.to < pairs_[pair].begin || jump.to > pairs_[pair].end) &&
            !comes_back(jump.to, pairs_[pair])) {
          auto& d =
              findings_.add(rules::JumpOutOfFor, program_.items[jump.item].span,
                            texts::OutsideTheLoop(number_of(jump.to)), texts::SetToEndValue());
          add_note(d, statement_of(pairs_[pair].begin).span, texts::TheLoop());
        }
    }
  }

  /// True if every path from here reaches the `next` of the loop or its body and does not leave it
  /// otherwise. Calls are assumed to return.
  bool comes_back(std::uint32_t from, const LoopPair& pair) const {
    struct Way {
      std::uint32_t code;
      bool called;
      bool operator==(const Way&) const = default;
    };
    constexpr std::size_t most = 64; // paths to follow; longer searches are given up
    std::vector<Way> ways{{from, false}};
    bool back = false;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const auto way = ways[i];
      const auto at = way.code < size_ ? ahead_[way.code] : none;
      if (at == none || ways.size() > most)
        return false;
      const auto& part = parts_[at];
      const auto& code = flow_.code[part.code];
      const bool about_loop = part.effect != Effect::Nothing && part.variable == pair.variable;
      if (about_loop && part.effect == Effect::Closes && !way.called) {
        back = true;
        continue;
      }
      const auto jumps = flow_.jumps_of(code);
      const bool stops = !code.falls && jumps.empty();
      if (about_loop || part.effect == Effect::Unsure || (part.returns && !way.called) ||
          (code.ends && !part.returns) || (stops && !part.returns))
        return false;
      const auto go = [&](Way next) {
        if (!next.called && next.code > pair.begin && next.code <= pair.end)
          back = true;
        else if (std::find(ways.begin(), ways.end(), next) == ways.end())
          ways.push_back(next);
      };
      for (const auto& jump : jumps)
        go({jump.to, way.called || jump.call});
      if (code.falls)
        go({part.code + 1, way.called});
    }
    return back;
  }

  void check_unended() {
    if ((set_ & ~stepped_) == 0)
      return;
    for (const auto& node : program_.statements)
      if (is(node, spec::Statement::For) && (stepped_ & bit(counter_of(node))) == 0)
        findings_.add(
            rules::ForWithoutNext, node.span,
            texts::LoopHasNo(fmt::format("next {}", spec::letter_name(counter_of(node)))));
  }

  // ---- in execution order

  /// Propagates the open loops along all paths, and through each subroutine once per set of loops
  /// that are open at its calls. Differences between two paths become unknown.
  void follow() {
    states_.reserve(parts_.size());
    work_.reserve(parts_.size());
    calls_.reserve(most_calls + 1);
    waiting_.reserve(most_calls);
    calls_.push_back({});
    reach(0, 0, {});
    while (!work_.empty()) {
      const auto state = work_.back();
      work_.pop_back();
      go_on(state);
    }
  }

  void reach(std::uint32_t call, std::uint32_t code, Loops loops) {
    const auto part = code < size_ ? ahead_[code] : none;
    if (part == none)
      return;
    auto at = parts_[part].first_state;
    while (at != none && states_[at].call != call)
      at = states_[at].next;
    if (at == none) {
      at = static_cast<std::uint32_t>(states_.size());
      states_.push_back({part, call, parts_[part].first_state, loops});
      parts_[part].first_state = at;
    } else if (states_[at].loops == loops || !states_[at].loops.known()) {
      return;
    } else {
      states_[at].loops = Loops::unknown();
    }
    work_.push_back(at);
  }

  void go_on(std::uint32_t index) {
    const auto call = states_[index].call;
    const auto& part = parts_[states_[index].part];
    const auto after = step(part, states_[index].loops);
    if (!after)
      return;
    const auto& code = flow_.code[part.code];
    bool calls = false;
    for (const auto& jump : flow_.jumps_of(code)) {
      if (jump.call && jump.to != none)
        enter(index, jump.to, *after);
      else if (!jump.call)
        reach(call, jump.to, *after);
      calls = calls || (jump.call && jump.to != none);
    }
    const bool branches = program_.statements[code.statement].then_branch != none;
    if (code.falls && (!calls || branches))
      reach(call, part.code + 1, *after);
    if (part.returns)
      give_back(call, *after);
  }

  void enter(std::uint32_t state, std::uint32_t entry, Loops loops) {
    if (calls_.size() >= most_calls)
      loops = Loops::unknown();
    const auto from = parts_[states_[state].part].code;
    auto at = std::find_if(calls_.begin() + 1, calls_.end(), [&](const Call& call) {
      return call.entry == entry && call.loops == loops;
    });
    if (at == calls_.end() && calls_.size() > most_calls)
      at = calls_.end() - 1; // shared by all further calls, with an unknown state
    else if (at == calls_.end())
      at = calls_.insert(at, {entry, loops, from, states_[state].call, {}});
    reach(static_cast<std::uint32_t>(at - calls_.begin()), entry, loops);
    wait(*at, state);
    if (at->returned)
      reach(states_[state].call, from + 1, *at->returned);
  }

  void wait(Call& call, std::uint32_t state) {
    const auto at = static_cast<std::uint32_t>(waiting_.size());
    (call.first_waiting == none ? call.first_waiting : waiting_[call.last_waiting].next) = at;
    call.last_waiting = at;
    waiting_.push_back({state, none});
  }

  void give_back(std::uint32_t call, Loops loops) {
    auto& returned = calls_[call].returned;
    if (returned == loops || (returned && !returned->known()))
      return;
    returned = returned ? Loops::unknown() : loops;
    for (auto at = calls_[call].first_waiting; at != none; at = waiting_[at].next) {
      const auto& state = states_[waiting_[at].state];
      reach(state.call, parts_[state.part].code + 1, *returned);
    }
  }

  /// The open loops after a part; nothing if it certainly ends the program.
  static std::optional<Loops> step(const Part& part, Loops loops) {
    if (part.effect == Effect::Unsure)
      return Loops::unknown();
    if (!loops.known() || part.effect == Effect::Nothing)
      return loops;
    const bool innermost = loops.count() > 0 && loops.innermost() == part.variable;
    if (part.effect == Effect::Closes) {
      if (!innermost)
        return std::nullopt;
      loops.close();
      return loops;
    }
    if (innermost)
      return loops; // restarts the innermost loop
    if (loops.count() == Loops::most)
      return std::nullopt;
    loops.open(part.variable);
    return loops;
  }

  // ---- reporting

  void report(const Part& part) {
    const auto& node = statement_of(part.code);
    if (part.effect == Effect::Closes && (set_ & bit(part.variable)) == 0) {
      add_next_of_nobody(part);
      return;
    }
    bool always = true;
    const PartState* stopped = nullptr;
    for (auto at = part.first_state; at != none; at = states_[at].next)
      if (step(part, states_[at].loops))
        always = false;
      else
        stopped = &states_[at];
    if (stopped == nullptr)
      return;
    if (part.effect == Effect::Opens)
      add_depth(node, *stopped).severity = always ? Severity::Error : Severity::Warning;
    else if (always)
      add_stray_next(node, stopped->loops);
  }

  /// True if more loops open on a letter than close on it.
  bool lacks_next(std::uint32_t variable) const {
    int open = 0;
    for (const auto& part : parts_)
      if (part.variable == variable)
        open += (part.effect == Effect::Opens ? 1 : 0) - (part.effect == Effect::Closes ? 1 : 0);
    return open > 0;
  }

  /// Reports a `next Q` without any `for Q`. If exactly one loop is open on every path and has no
  /// `next`, this one belongs to it.
  void add_next_of_nobody(const Part& part) {
    const auto& node = statement_of(part.code);
    auto& d =
        findings_.add(rules::NextWithoutFor, node.span,
                      texts::ThereIsNo(fmt::format("for {}", spec::letter_name(part.variable))));
    std::optional<std::uint32_t> innermost;
    for (auto at = part.first_state; at != none; at = states_[at].next) {
      const auto& loops = states_[at].loops;
      if (!loops.known() || loops.count() == 0)
        return;
      const std::uint32_t here = loops.innermost();
      if (innermost.value_or(here) != here)
        return;
      innermost = here;
    }
    if (!innermost || !lacks_next(*innermost))
      return;
    d.help = texts::Write(fmt::format("next {}", spec::letter_name(*innermost)));
    d.fix = single_fix(d.help, program_.as<NextView>(node).variable.span,
                       std::string(1, spec::letter_name(*innermost)));
  }

  Diagnostic& add_depth(const StatementNode& node, const PartState& state) {
    std::vector<const Call*> calls; // outermost first
    for (const auto* call = &calls_[state.call]; call->from != none;
         call = &calls_[call->from_call])
      calls.insert(calls.begin(), call);
    auto& d = findings_.add(rules::ForDepth, node.span, texts::LoopsAreOpen(state.loops.count()),
                            texts::EndOneFirst());
    for (const auto* call : calls) {
      const auto& more = d.notes.empty() ? texts::AsLineCalls : texts::AndLineCalls;
      d.message = more(d.message, number_of(call->from), number_of(call->entry));
      add_note(d, statement_of(call->from).span, texts::CalledHere());
    }
    return d;
  }

  void add_stray_next(const StatementNode& node, Loops loops) {
    if (loops.count() == 0) {
      findings_.add(rules::NextWithoutFor, node.span, texts::Without("next", "for"));
      return;
    }
    const auto innermost = spec::letter_name(loops.innermost());
    findings_.add(rules::NextWithoutFor, node.span, texts::InnermostLoopVariable(innermost),
                  texts::EndItFirst(fmt::format("next {}", innermost)));
  }

  /// Above this limit, calls are no longer distinguished: no program in a robot has as many, and a
  /// linter must not take minutes.
  static constexpr std::size_t most_calls = 64;

  LetterSet set_ = 0;                ///< letters of a `for`
  LetterSet stepped_ = 0;            ///< letters of a `next`
  std::vector<Part> parts_;          ///< in text order
  std::vector<std::uint32_t> ahead_; ///< by line of code: the first part at or after it
  std::vector<LoopPair> pairs_;
  std::vector<Call> calls_; ///< the first is the main program
  std::vector<Waiting> waiting_;
  std::vector<PartState> states_;
  std::vector<std::uint32_t> work_; ///< work list of states
};

} // namespace

void lint_loops(const Program& program, const Flow& flow, Findings& findings) {
  LoopRules(program, flow, findings).run();
}

} // namespace orb::compiler
