#include "compiler/lint_passes.h"

#include "compiler/rules.h"
#include "spec/limits.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace orb::compiler {
namespace {

constexpr std::uint32_t indexed = spec::letter_count; // Z in masks and stacks of loop variables

std::uint32_t variable_of(const Item& item) {
  return item.kind == ItemKind::Letter ? item.value : indexed;
}

bool is(const StatementNode& node, spec::Statement kind) {
  return !node.error && node.kind == kind;
}

/// The open loops before a line, as far as they are the same on every way that leads there.
struct Loops {
  static constexpr std::uint32_t most = spec::value_of(spec::Limit::ForDepth);

  bool known = true;
  std::uint8_t count = 0;
  std::uint32_t variables = 0; ///< a byte each, the innermost lowest

  static Loops unknown() { return {false, 0, 0}; }
  std::uint32_t innermost() const { return variables & UINT8_MAX; }
  void open(std::uint32_t variable) {
    variables = variables << 8 | variable;
    ++count;
  }
  void close() {
    variables >>= 8;
    --count;
  }
  friend bool operator==(const Loops&, const Loops&) = default;
};
static_assert(Loops::most <= sizeof Loops::variables);

/// The main program, or a subroutine called while these loops are open.
struct Call {
  std::uint32_t entry = 0; ///< a line of code
  Loops loops;
  std::uint32_t from = none;          ///< the first line of code that calls it so
  std::uint32_t from_call = none;     ///< where that line runs
  std::optional<Loops> returned;      ///< what its `return`s leave open
  std::vector<std::uint32_t> waiting; ///< states that go on when it returns
};

/// What is known of a line while a call runs it.
struct State {
  std::uint32_t code = 0;
  std::uint32_t call = 0;
  std::uint32_t next = none; ///< the next state of the same line
  Loops loops;
};

class LoopRules {
public:
  LoopRules(const Program& program, const Flow& flow, Findings& findings)
      : program_(program), flow_(flow), findings_(findings),
        size_(static_cast<std::uint32_t>(flow.code.size())) {}

  void run() {
    for (const auto& node : program_.statements) {
      if (is(node, spec::Statement::For))
        set_ |= bit(counter_of(node));
      else if (is(node, spec::Statement::Next))
        stepped_ |= bit(stepped_by(node));
    }
    if (set_ == 0 && stepped_ == 0)
      return;
    match_pairs();
    check_jumps();
    check_unended();
    follow();
    for (std::uint32_t i = 0; i < size_; ++i)
      report(i);
  }

private:
  static constexpr std::uint32_t bit(std::uint32_t variable) {
    return std::uint32_t{1} << variable;
  }
  const StatementNode& statement(std::uint32_t code) const {
    return program_.statements[flow_.code[code].statement];
  }
  std::uint32_t number_of(std::uint32_t code) const {
    return program_.lines[flow_.code[code].line].number;
  }
  std::uint32_t counter_of(const StatementNode& node) const {
    return variable_of(program_.as<ForView>(node).variable);
  }
  std::uint32_t stepped_by(const StatementNode& node) const {
    return variable_of(program_.as<NextView>(node).variable);
  }

  // ---- as they stand in the text

  struct Pair {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t outer;
  };

  /// Pairs `for` and `next` in the order of the text.
  void match_pairs() {
    std::vector<std::uint32_t> open;
    innermost_.assign(size_, none);
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& node = statement(i);
      if (is(node, spec::Statement::For)) {
        const auto outer = open.empty() ? none : open.back();
        open.push_back(static_cast<std::uint32_t>(pairs_.size()));
        pairs_.push_back({i, none, outer});
      }
      innermost_[i] = open.empty() ? none : open.back();
      if (!is(node, spec::Statement::Next))
        continue;
      const auto variable = stepped_by(node);
      while (!open.empty() && counter_of(statement(pairs_[open.back()].begin)) != variable)
        open.pop_back();
      if (!open.empty()) {
        pairs_[open.back()].end = i;
        open.pop_back();
      }
    }
  }

  void check_jumps() {
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto jumps = flow_.jumps_of(flow_.code[i]);
      auto pair = jumps.empty() ? none : innermost_[i];
      while (pair != none && (pairs_[pair].end == none || i > pairs_[pair].end))
        pair = pairs_[pair].outer;
      if (pair == none)
        continue;
      for (const auto& jump : jumps)
        if (!jump.call && jump.to != none &&
            (jump.to < pairs_[pair].begin || jump.to > pairs_[pair].end)) {
          auto& d = findings_.add(
              rules::JumpOutOfFor, program_.items[jump.item].span,
              fmt::format("line {} is outside the loop, which stays open", number_of(jump.to)),
              "set the loop variable to its end value and go to the `next`");
          add_note(d, statement(pairs_[pair].begin).span, "the loop");
        }
    }
  }

  void check_unended() {
    for (const auto& node : program_.statements)
      if (is(node, spec::Statement::For) && (stepped_ & bit(counter_of(node))) == 0)
        findings_.add(
            rules::ForWithoutNext, node.span,
            fmt::format("the loop has no `next {}`", spec::letter_name(counter_of(node))));
  }

  // ---- as they run

  /// Carries the open loops along every way, through each subroutine once for each set of open
  /// loops with which it is called. What differs between two ways is unknown.
  void follow() {
    first_state_.assign(size_, none);
    ahead_.assign(size_ + 1, size_);
    for (std::uint32_t i = size_; i-- > 0;)
      ahead_[i] = is_plain(i) ? ahead_[i + 1] : i;
    calls_.push_back({});
    reach(0, 0, {});
    while (!work_.empty()) {
      const auto state = work_.back();
      work_.pop_back();
      go_on(state);
    }
  }

  /// Whether a line only leads to the next one, with the same loops open.
  bool is_plain(std::uint32_t i) const {
    const auto& code = flow_.code[i];
    const auto whole = program_.whole(statement(i));
    return code.falls && flow_.jumps_of(code).empty() &&
           std::none_of(whole.begin(), whole.end(), [](const auto& node) {
             return is_loop_part(node) || is(node, spec::Statement::Return);
           });
  }

  void reach(std::uint32_t call, std::uint32_t code, const Loops& loops) {
    code = ahead_[std::min(code, size_)];
    if (code == size_)
      return;
    auto at = first_state_[code];
    while (at != none && states_[at].call != call)
      at = states_[at].next;
    if (at == none) {
      at = static_cast<std::uint32_t>(states_.size());
      states_.push_back({code, call, first_state_[code], loops});
      first_state_[code] = at;
    } else if (states_[at].loops == loops || !states_[at].loops.known) {
      return;
    } else {
      states_[at].loops = Loops::unknown();
    }
    work_.push_back(at);
  }

  void go_on(std::uint32_t index) {
    const auto [i, call, next, before] = states_[index];
    const auto after = step(i, before);
    if (!after)
      return;
    const auto& code = flow_.code[i];
    const auto whole = program_.whole(statement(i));
    bool calls = false;
    for (const auto& jump : flow_.jumps_of(code)) {
      if (jump.call && jump.to != none)
        enter(index, jump.to, *after);
      else if (!jump.call)
        reach(call, jump.to, *after);
      calls = calls || (jump.call && jump.to != none);
    }
    if (code.falls && (!calls || whole.size() > 1))
      reach(call, i + 1, *after);
    if (std::any_of(whole.begin(), whole.end(),
                    [](const auto& node) { return is(node, spec::Statement::Return); }))
      give_back(call, *after);
  }

  void enter(std::uint32_t state, std::uint32_t entry, Loops loops) {
    if (calls_.size() >= most_calls)
      loops = Loops::unknown();
    auto at = std::find_if(calls_.begin() + 1, calls_.end(), [&](const Call& call) {
      return call.entry == entry && call.loops == loops;
    });
    if (at == calls_.end()) {
      at = calls_.insert(at, {entry, loops, states_[state].code, states_[state].call, {}, {}});
      reach(static_cast<std::uint32_t>(at - calls_.begin()), entry, loops);
    }
    if (std::find(at->waiting.begin(), at->waiting.end(), state) == at->waiting.end())
      at->waiting.push_back(state);
    if (at->returned)
      reach(states_[state].call, states_[state].code + 1, *at->returned);
  }

  void give_back(std::uint32_t call, const Loops& loops) {
    auto& returned = calls_[call].returned;
    if (returned == loops || (returned && !returned->known))
      return;
    returned = returned ? Loops::unknown() : loops;
    for (const auto state : calls_[call].waiting)
      reach(states_[state].call, states_[state].code + 1, *returned);
  }

  /// The loops after line `i`; nothing where the line ends the program for certain.
  std::optional<Loops> step(std::uint32_t i, Loops loops) const {
    const auto& node = statement(i);
    if (node.then_branch != none) {
      const auto whole = program_.whole(node);
      return std::any_of(whole.begin(), whole.end(), is_loop_part) ? Loops::unknown() : loops;
    }
    if (!loops.known || !is_loop_part(node))
      return loops;
    if (node.kind == spec::Statement::Next) {
      if (loops.count == 0 || loops.innermost() != stepped_by(node))
        return std::nullopt;
      loops.close();
      return loops;
    }
    const auto variable = counter_of(node);
    if (loops.count > 0 && loops.innermost() == variable)
      return loops; // the innermost loop begins again
    if (loops.count == Loops::most)
      return std::nullopt;
    loops.open(variable);
    return loops;
  }

  static bool is_loop_part(const StatementNode& node) {
    return is(node, spec::Statement::For) || is(node, spec::Statement::Next);
  }

  // ---- what is said of it

  void report(std::uint32_t i) {
    const auto& node = statement(i);
    if (!is_loop_part(node))
      return;
    if (is(node, spec::Statement::Next) && (set_ & bit(stepped_by(node))) == 0) {
      add_next_of_nobody(i);
      return;
    }
    bool always = true;
    const State* stopped = nullptr;
    for (auto at = first_state_[i]; at != none; at = states_[at].next)
      if (step(i, states_[at].loops))
        always = false;
      else
        stopped = &states_[at];
    if (stopped == nullptr)
      return;
    if (is(node, spec::Statement::For))
      add_depth(node, *stopped).severity = always ? Severity::Error : Severity::Warning;
    else if (always)
      add_stray_next(node, stopped->loops);
  }

  /// Whether more loops count in a letter than end with it.
  bool lacks_next(std::uint32_t variable) const {
    int open = 0;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const auto& node = statement(i);
      open += is(node, spec::Statement::For) && counter_of(node) == variable ? 1 : 0;
      open -= is(node, spec::Statement::Next) && stepped_by(node) == variable ? 1 : 0;
    }
    return open > 0;
  }

  /// `next Q` without any `for Q`: where one loop is open on every way and lacks its `next`, this
  /// is the one.
  void add_next_of_nobody(std::uint32_t i) {
    const auto& node = statement(i);
    auto& d =
        findings_.add(rules::NextWithoutFor, node.span,
                      fmt::format("there is no `for {}`", spec::letter_name(stepped_by(node))));
    std::optional<std::uint32_t> innermost;
    for (auto at = first_state_[i]; at != none; at = states_[at].next) {
      const auto& loops = states_[at].loops;
      if (!loops.known || loops.count == 0)
        return;
      const std::uint32_t here = loops.innermost();
      if (innermost.value_or(here) != here)
        return;
      innermost = here;
    }
    if (!innermost || !lacks_next(*innermost))
      return;
    d.help = fmt::format("write `next {}`", spec::letter_name(*innermost));
    d.fix = single_fix(d.help, program_.as<NextView>(node).variable.span,
                       std::string(1, spec::letter_name(*innermost)));
  }

  Diagnostic& add_depth(const StatementNode& node, const State& state) {
    std::string chain;
    std::vector<std::uint32_t> callers; // outermost first
    for (const auto* call = &calls_[state.call]; call->from != none;
         call = &calls_[call->from_call]) {
      chain = fmt::format("{} line {} calls line {}{}", call->from_call == 0 ? ", as" : " and",
                          number_of(call->from), number_of(call->entry), chain);
      callers.insert(callers.begin(), call->from);
    }
    auto& d =
        findings_.add(rules::ForDepth, node.span,
                      fmt::format("{} loops are already open here{}", state.loops.count, chain),
                      "end one of them first, or compute two counters from one");
    for (const auto caller : callers)
      add_note(d, statement(caller).span, "called here");
    return d;
  }

  void add_stray_next(const StatementNode& node, const Loops& loops) {
    if (loops.count == 0) {
      findings_.add(rules::NextWithoutFor, node.span, "no loop is open here");
      return;
    }
    const auto innermost = spec::letter_name(loops.innermost());
    findings_.add(rules::NextWithoutFor, node.span,
                  fmt::format("the innermost loop counts in `{}`", innermost),
                  fmt::format("end it first: `next {}`", innermost));
  }

  /// Beyond these, calls of the same subroutine are not told apart any more: no program that fits
  /// into a robot has as many, and a linter must not take minutes over one.
  static constexpr std::size_t most_calls = 64;

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::uint32_t size_;
  std::uint32_t set_ = 0;     ///< letters that some `for` counts in
  std::uint32_t stepped_ = 0; ///< letters that some `next` steps
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> innermost_; ///< by line of code: the pair around it
  std::vector<Call> calls_;              ///< the first is the main program
  std::vector<State> states_;
  std::vector<std::uint32_t> first_state_; ///< by line of code
  std::vector<std::uint32_t> ahead_;       ///< by line of code: from there on the first not plain
  std::vector<std::uint32_t> work_;        ///< states to go on from
};

} // namespace

void lint_loops(const Program& program, const Flow& flow, Findings& findings) {
  LoopRules(program, flow, findings).run();
}

} // namespace orb::compiler
