#include "structured/optimise/split.h"

#include "structured/analyse/sizes.h"
#include "structured/optimise/jumps.h"

#include <algorithm>
#include <optional>

namespace orb::structured {
namespace {

/// Bytes that may be spent to run fewer lines, without a call and its `return`.
constexpr std::uint32_t call_slack = 6;

bool is_pure_test(const Code& code, const CodeLine& line) {
  const auto& condition = code.conditions[line.condition];
  return !line.guard && condition.glue == Glue::None && is_pure(effects_of(code, line));
}

/// Executes a line on the state; returns false if a path to copy must not contain it.
bool pass(const Code& code, const Ranges& ranges, const CodeLine& line, VariableRanges& state) {
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

/// Finds calls of subs that do little with the values known there.
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
    ranges_.each_state([&](std::uint32_t i, const VariableRanges& state) {
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
  struct RoutineCost {
    std::uint32_t calls = 0;
    std::uint32_t bytes = 0;
    std::vector<Site> sites;
  };

  /// Collects the effective lines of a call if every test on its path is decided.
  void follow(std::uint32_t call, VariableRanges state) {
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

  /// The label that a line jumps to, or none for the line below; nothing if it is unknown or the
  /// line has an effect.
  std::optional<std::uint32_t> decided_target(const CodeLine& line,
                                              const VariableRanges& state) const {
    if (line.kind == LineKind::Goto)
      return line.label;
    if (line.kind == LineKind::If && is_pure_test(code_, line)) {
      const auto answer = answer_of(ranges_, code_.conditions[line.condition].first, state);
      return answer ? std::optional(*answer ? line.label : none) : std::nullopt;
    }
    if (line.kind != LineKind::On || !is_pure(effects_of(code_, line)))
      return std::nullopt;
    const auto label = chosen_label(code_, ranges_, line, state);
    return label == none ? std::nullopt : std::optional(label);
  }

  /// True if the lines that replace a call are not longer, or if they make the sub unnecessary.
  static bool is_worth(const RoutineCost& routine, const Site& site) {
    if (routine.calls < 2)
      return false; // it is inlined as a whole
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
  std::vector<RoutineCost> routines_;
};

} // namespace

bool split_ways(Code& code, Ranges& ranges) {
  return CallSplitter(code, ranges).run();
}

} // namespace orb::structured
