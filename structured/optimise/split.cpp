#include "structured/optimise/split.h"

#include "structured/analyse/sizes.h"
#include "structured/optimise/arms.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

// Bytes that fewer lines on the way may cost.
constexpr std::uint32_t test_slack = 12; ///< without the test
constexpr std::uint32_t call_slack = 6;  ///< without a call and its `return`

bool is_pure_test(const Code& code, const CodeLine& line) {
  const auto& condition = code.conditions[line.condition];
  return !line.guard && condition.glue == Glue::None && is_pure(effects_of(code, line));
}

/// Goes over a line that may stand on a way; false where it may not.
bool pass(const Code& code, const Ranges& ranges, const CodeLine& line, State& state) {
  switch (line.kind) {
  case LineKind::Let: state[line.variable] = ranges.range_of(line.term, state); return true;
  case LineKind::Nothing:
  case LineKind::Label:
  case LineKind::SetElement:
  case LineKind::SetSystem:
  case LineKind::Print: return true;
  case LineKind::Do:
    each_write(code, line, [&](std::uint32_t v) { state[v] = {}; });
    return falls_through(line);
  case LineKind::Gosub:
    each_member(ranges.flow().written[line.variable], [&](std::uint32_t v) { state[v] = {}; });
    return true;
  case LineKind::Goto:
  case LineKind::If:
  case LineKind::For:
  case LineKind::Next:
  case LineKind::Return:
  case LineKind::Switch:
  case LineKind::On:
  case LineKind::Choice: return false;
  }
  return false;
}

/// How a test that is alone in its line ends.
Outcome outcome_of(const Code& code, const Ranges& ranges, const CodeLine& test,
                   const State& state) {
  return structured::outcome_of(ranges, code.conditions[test.condition].first, state);
}

/// Tests whose outcome is known on each way to the few lines before them, or on all ways but one.
class TestSplitter {
public:
  TestSplitter(Code& code, Ranges& ranges) : code_(code), ranges_(ranges), flow_(ranges.flow()) {}

  bool run() {
    find_tests();
    ranges_.each_state([](std::uint32_t, const State&) {},
                       [&](std::uint32_t b, State& state) { leave(b, state); });
    for (std::uint32_t b = 0; b < tests_.size(); ++b)
      if (tests_[b].fits && split(b))
        return true;
    return false;
  }

private:
  /// A way into a block: the line that jumps there, or none where the block above runs into it.
  struct Way {
    std::uint32_t jump;
    Outcome outcome; ///< of the test at the end of the block
    bool known() const { return outcome != Outcome::Unknown; }
    bool holds() const { return outcome == Outcome::Always; }
  };
  struct Test {
    bool fits = false;
    std::uint32_t bytes = 0; ///< of the lines before the test
    std::vector<Way> ways;
  };

  void find_tests() {
    tests_.resize(flow_.blocks.size());
    State state(code_.variables.size());
    const auto named = names_of_labels(code_);
    for (std::uint32_t b = 0; b < tests_.size(); ++b) {
      const auto& block = flow_.blocks[b];
      const auto& last = code_.lines[block.end - 1];
      auto& test = tests_[b];
      test.fits = last.kind == LineKind::If && is_pure_test(code_, last) &&
                  flow_.block_of_label[last.label] != none && ranges_.reaches(b) &&
                  !is_one_line(code_, named, block.end - 1);
      for (auto i = block.begin; test.fits && i + 1 < block.end; ++i) {
        test.fits =
            pass(code_, ranges_, code_.lines[i], state) && code_.lines[i].kind != LineKind::Gosub;
        test.bytes += bytes_of(code_, code_.lines[i]);
      }
      test.fits = test.fits && test.bytes <= bytes_of(code_, last) + test_slack;
    }
    for (const auto entry : flow_.entries)
      if (entry != none)
        tests_[entry].fits = false;
  }

  void leave(std::uint32_t b, State& state) {
    const auto end = flow_.blocks[b].end;
    const auto& line = code_.lines[end - 1];
    const auto target =
        line.label < flow_.block_of_label.size() ? flow_.block_of_label[line.label] : none;
    if (target == b)
      tests_[b].fits = false;
    if (line.kind == LineKind::Goto) {
      enter(target, end - 1, state);
    } else if (line.kind == LineKind::If && code_.conditions[line.condition].glue == Glue::None) {
      const auto& relation = code_.conditions[line.condition].first;
      if (target != none && tests_[target].fits) {
        auto taken = state;
        if (ranges_.narrow(relation, relation.comparison, taken))
          enter(target, end - 1, taken);
      }
      if (b + 1 < tests_.size() && tests_[b + 1].fits &&
          ranges_.narrow(relation, opposite(relation.comparison), state))
        enter(b + 1, none, state);
    } else if (line.kind == LineKind::Next || line.kind == LineKind::If || !falls_through(line)) {
      for (const auto next : flow_.successors_of(flow_.blocks[b]))
        tests_[next].fits = false;
    } else if (b + 1 < tests_.size()) {
      enter(b + 1, none, state);
    }
  }

  void enter(std::uint32_t b, std::uint32_t jump, State state) {
    if (b == none || !tests_[b].fits)
      return;
    const auto& block = flow_.blocks[b];
    for (auto i = block.begin; i + 1 < block.end; ++i)
      pass(code_, ranges_, code_.lines[i], state);
    tests_[b].ways.push_back({jump, outcome_of(code_, ranges_, code_.lines[block.end - 1], state)});
  }

  /// Writes the lines of a block a second time, for the ways on which its test goes the other way
  /// than where the lines stand.
  bool split(std::uint32_t b) {
    const auto& ways = tests_[b].ways;
    if (std::any_of(ways.begin(), ways.end(), [](const Way& way) { return !way.known(); }))
      return move(b);
    const auto falling =
        std::find_if(ways.begin(), ways.end(), [](const Way& way) { return way.jump == none; });
    const auto holding =
        std::count_if(ways.begin(), ways.end(), [](const Way& way) { return way.holds(); });
    if (tests_[b].bytes == 0 || holding == 0 || std::size_t(holding) == ways.size())
      return false; // one test for all of them: it goes without a copy
    const bool stays =
        falling != ways.end() ? falling->holds() : std::size_t(holding) * 2 > ways.size();
    const auto site = std::find_if(ways.begin(), ways.end(), [&](const Way& way) {
      return way.holds() != stays && code_.lines[way.jump].kind == LineKind::Goto;
    });
    if (site == ways.end())
      return false;
    write(b, stays, site->jump, ways);
    return true;
  }

  /// Makes the test where the jump stands that is the only way on which it is not decided, if the
  /// block above, which runs into it, decides it.
  bool move(std::uint32_t b) {
    const auto& ways = tests_[b].ways;
    if (tests_[b].bytes > 0 || ways.size() != 2)
      return false;
    const auto& unknown = ways[ways[0].known() ? 1 : 0];
    const auto& known = ways[ways[0].known() ? 0 : 1];
    if (!known.known() || known.jump != none || code_.lines[unknown.jump].kind != LineKind::Goto)
      return false;
    const auto place = flow_.blocks[b].end - 1;
    const auto test = code_.lines[place];
    const auto below = code_.labels++;
    code_.lines[place].kind = known.holds() ? LineKind::Goto : LineKind::Nothing;
    code_.lines[unknown.jump].label = below;
    auto label = test;
    label.kind = LineKind::Label;
    label.label = below;
    const auto begin = code_.lines.begin();
    if (unknown.jump > place) {
      code_.lines.insert(begin + unknown.jump, test);
      code_.lines.insert(code_.lines.begin() + place + 1, label);
    } else {
      code_.lines.insert(begin + place + 1, label);
      code_.lines.insert(code_.lines.begin() + unknown.jump, test);
    }
    return true;
  }

  void write(std::uint32_t b, bool stays, std::uint32_t site, const std::vector<Way>& ways) {
    const auto block = flow_.blocks[b];
    const auto test = code_.lines[block.end - 1];
    const auto label = code_.labels++;
    const auto below = code_.labels++;
    const auto line_of = [&](LineKind kind, std::uint32_t to) {
      auto line = code_.lines[site];
      line.kind = kind;
      line.label = to;
      return line;
    };
    std::vector<CodeLine> copy{line_of(LineKind::Label, label)};
    for (auto i = block.begin; i + 1 < block.end; ++i)
      if (bytes_of(code_, code_.lines[i]) > 0)
        copy.push_back(copy_line(code_, code_.lines[i]));
    copy.push_back(line_of(LineKind::Goto, stays ? below : test.label));
    for (const auto& way : ways)
      if (way.holds() != stays && way.jump != site)
        code_.lines[way.jump].label = label;
    auto& last = code_.lines[block.end - 1];
    last.kind = stays ? LineKind::Goto : LineKind::Nothing;
    std::vector<CodeLine> lines;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      if (i == site)
        lines.insert(lines.end(), copy.begin(), copy.end());
      else
        lines.push_back(code_.lines[i]);
      if (i == block.end - 1) {
        lines.push_back(test);
        lines.back().kind = LineKind::Label;
        lines.back().label = below;
      }
    }
    code_.lines = std::move(lines);
  }

  Code& code_;
  Ranges& ranges_;
  const Flow& flow_;
  std::vector<Test> tests_; ///< of each block
};

/// Calls of subs that do little with what is known there.
class CallSplitter {
public:
  CallSplitter(Code& code, Ranges& ranges)
      : code_(code), ranges_(ranges), at_(lines_of_labels(code)), routines_(code.routines.size()) {}

  bool run() {
    for (const auto& line : code_.lines) {
      if (line.kind != LineKind::Return)
        routines_[line.routine].bytes += bytes_of(code_, line);
      if (const auto callee = callee_of(line); callee != none)
        ++routines_[callee].calls;
    }
    ranges_.each_state([&](std::uint32_t i, const State& state) {
      if (code_.lines[i].kind == LineKind::Gosub)
        follow(i, state);
    });
    std::vector<const Site*> chosen(code_.lines.size(), nullptr);
    bool any = false;
    for (const auto& routine : routines_)
      for (const auto& site : routine.sites)
        if (is_worth(routine, site)) {
          chosen[site.line] = &site;
          any = true;
        }
    if (any)
      write(chosen);
    return any;
  }

private:
  struct Site {
    std::uint32_t line = 0;
    std::uint32_t bytes = 0;
    std::vector<std::uint32_t> lines;
  };
  struct Routine {
    std::uint32_t calls = 0;
    std::uint32_t bytes = 0;
    std::vector<Site> sites;
  };

  /// Gathers what a call does if each test on its way is decided.
  void follow(std::uint32_t call, State state) {
    constexpr int longest = 48;
    constexpr std::uint32_t most_bytes = 64;
    Site site{call, 0, {}};
    auto i = at_[code_.lines[call].label];
    for (int steps = 0; i < code_.lines.size() && steps < longest; ++steps) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Return) {
        routines_[code_.lines[call].variable].sites.push_back(std::move(site));
        return;
      }
      if (const auto target = decided_target(line, state)) {
        i = *target == none ? i + 1 : at_[*target];
        continue;
      }
      if (!pass(code_, ranges_, line, state) || (site.bytes += bytes_of(code_, line)) > most_bytes)
        return;
      if (bytes_of(code_, line) > 0)
        site.lines.push_back(i);
      ++i;
    }
  }

  /// The label that a line leads to, or none for the line below; nothing where that is not known
  /// or the line does something.
  std::optional<std::uint32_t> decided_target(const CodeLine& line, const State& state) const {
    if (line.kind == LineKind::Goto)
      return line.label;
    if (line.kind == LineKind::If && is_pure_test(code_, line)) {
      const auto outcome = outcome_of(code_, ranges_, line, state);
      return outcome == Outcome::Unknown
                 ? std::nullopt
                 : std::optional(outcome == Outcome::Always ? line.label : none);
    }
    if (line.kind != LineKind::On || !is_pure(effects_of(code_, line)))
      return std::nullopt;
    const auto label = chosen_label(code_, ranges_, line, state);
    return label == none ? std::nullopt : std::optional(label);
  }

  /// Whether lines in place of a call are no longer, or where they do away with the sub.
  static bool is_worth(const Routine& routine, const Site& site) {
    if (routine.calls < 2)
      return false; // it is written into its caller as it is
    if (site.bytes <= call_bytes + call_slack)
      return true;
    std::uint32_t all = 0;
    for (const auto& one : routine.sites)
      all += one.bytes;
    const auto calls = static_cast<std::uint32_t>(routine.sites.size());
    if (calls + 1 < routine.calls)
      return false;
    const auto rest = calls == routine.calls ? 0 : routine.bytes;
    return all + rest <= routine.calls * (call_bytes + call_slack) + routine.bytes + return_bytes;
  }

  void write(const std::vector<const Site*>& chosen) {
    const auto before = std::move(code_.lines);
    code_.lines.clear();
    for (std::uint32_t i = 0; i < before.size(); ++i) {
      if (chosen[i] == nullptr) {
        code_.lines.push_back(before[i]);
        continue;
      }
      for (const auto n : chosen[i]->lines) {
        auto line = copy_line(code_, before[n]);
        line.routine = before[i].routine;
        code_.lines.push_back(line);
      }
    }
  }

  Code& code_;
  Ranges& ranges_;
  std::vector<std::uint32_t> at_; ///< of each label: its line
  std::vector<Routine> routines_;
};

} // namespace

bool split_ways(Code& code, Ranges& ranges) {
  return TestSplitter(code, ranges).run() || CallSplitter(code, ranges).run();
}

} // namespace orb::structured
