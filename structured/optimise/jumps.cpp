#include "structured/optimise/jumps.h"

#include "structured/analyse/flow.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace orb::structured {
namespace {

class Cleaner {
public:
  explicit Cleaner(Code& code) : code_(code) {}

  bool run() {
    constexpr int most_rounds = 8;
    std::erase_if(code_.lines, [](const CodeLine& line) { return line.kind == LineKind::Nothing; });
    int round = 0;
    while (round < most_rounds && once())
      ++round;
    return round > 0;
  }

private:
  bool once() {
    changed_ = false;
    at_ = lines_of_labels(code_);
    thread();
    remove_unreached();
    remove_idle();
    tidy(code_);
    return changed_;
  }

  /// The first effective line after a label; none at the end of the text.
  std::uint32_t after(std::uint32_t line) const {
    while (line < code_.lines.size() && (code_.lines[line].kind == LineKind::Label ||
                                         code_.lines[line].kind == LineKind::Nothing))
      ++line;
    return line < code_.lines.size() ? line : none;
  }

  /// The final target of a jump to `label`; one label stands for all adjacent ones.
  std::uint32_t end_of(std::uint32_t label) const {
    for (int steps = 0; steps < 16; ++steps) {
      if (at_[label] == none)
        return label;
      const auto line = after(at_[label]);
      if (line != none && code_.lines[line].kind == LineKind::Goto &&
          code_.lines[line].label != label) {
        label = code_.lines[line].label;
        continue;
      }
      auto first = at_[label];
      while (first > 0 && code_.lines[first - 1].kind == LineKind::Label)
        --first;
      return code_.lines[first].label;
    }
    return label;
  }

  void redirect(std::uint32_t& label) {
    const auto end = end_of(label);
    changed_ = changed_ || end != label;
    label = end;
  }

  void thread() {
    for (auto& line : code_.lines)
      if (line.kind != LineKind::Next) // its label identifies its loop
        each_label(code_, line, [&](std::uint32_t& label) { redirect(label); });
    for (std::size_t r = 1; r < code_.routines.size(); ++r)
      if (code_.routines[r] != none)
        code_.routines[r] = end_of(code_.routines[r]);
  }

  void remove_unreached() {
    std::vector<bool> reached(code_.lines.size(), false);
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      auto i = open.back();
      open.pop_back();
      for (bool on = true; on && i < reached.size() && !reached[i]; ++i) {
        reached[i] = true;
        const auto& line = code_.lines[i];
        each_label(code_, line, [&](std::uint32_t label) { open.push_back(at_[label]); });
        on = falls_through(line);
      }
    }
    std::vector<bool> stepped(code_.labels, false);
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i)
      if (reached[i] && code_.lines[i].kind == LineKind::Next)
        stepped[code_.lines[i].label] = true;
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      auto& line = code_.lines[i];
      if (!reached[i]) {
        line.kind = LineKind::Nothing;
        changed_ = true;
      } else if (line.kind == LineKind::For && !stepped[line.label]) {
        // The body never reaches the `next`: only the initial assignment remains.
        line.kind = LineKind::Let;
        changed_ = true;
      }
    }
    for (std::size_t r = 1; r < code_.routines.size(); ++r)
      if (const auto label = code_.routines[r];
          label != none && (at_[label] == none || !reached[at_[label]]))
        code_.routines[r] = none;
  }

  bool has_effects(const CodeLine& line) const {
    std::uint8_t effects = 0;
    each_root(code_, line, [&](std::uint32_t root) { effects |= code_.terms[root].effects; });
    return (effects & (effect::faults | effect::clears)) != 0;
  }

  /// Removes jumps to the next line, and merges two jumps into one.
  void remove_idle() {
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      auto& line = code_.lines[i];
      const bool jumps = line.kind == LineKind::Goto;
      if (!jumps && line.kind != LineKind::If)
        continue;
      const auto next = after(i + 1);
      const auto target = at_[line.label] == none ? none : after(at_[line.label]);
      if (next == target && (jumps || !has_effects(line))) {
        line.kind = LineKind::Nothing;
        changed_ = true;
      } else if (line.kind == LineKind::If && code_.conditions[line.condition].glue == Glue::None &&
                 next != none && code_.lines[next].kind == LineKind::Goto && next == i + 1 &&
                 after(next + 1) == target) {
        auto& relation = code_.conditions[line.condition].first;
        relation.comparison = opposite(relation.comparison);
        line.guard = false;
        line.label = code_.lines[next].label;
        code_.lines[next].kind = LineKind::Nothing;
        changed_ = true;
      }
    }
  }

  Code& code_;
  std::vector<std::uint32_t> at_; ///< of each label: its line
  bool changed_ = false;
};

} // namespace

std::vector<std::uint32_t> loops_of_lines(const Code& code) {
  std::vector<std::uint32_t> loops;
  std::vector<std::uint32_t> open{none};
  for (const auto& line : code.lines) {
    loops.push_back(open.back());
    if (line.kind == LineKind::For)
      open.push_back(line.label);
    else if (line.kind == LineKind::Next && open.size() > 1)
      open.pop_back();
  }
  return loops;
}

bool straighten(Code& code) {
  bool changed = false;
  auto loops = loops_of_lines(code);
  auto at = lines_of_labels(code);
  auto& lines = code.lines;
  /// The lines after a label if they can move to a jump at `i`: first and last.
  const auto movable = [&](std::uint32_t i, std::uint32_t label) {
    constexpr auto stay = std::pair{none, none};
    if (at[label] == none)
      return stay;
    auto first = at[label];
    while (first > 0 && lines[first - 1].kind == LineKind::Label)
      --first;
    if (first == 0 || falls_through(lines[first - 1]))
      return stay;
    auto last = first;
    while (last < lines.size() && falls_through(lines[last]))
      ++last;
    if (last == lines.size() || (first <= i && i <= last))
      return stay;
    // Keep a loop, and the lines inside it, together.
    const bool cuts =
        std::any_of(lines.begin() + first, lines.begin() + last, [&](const auto& line) {
          return line.kind == LineKind::Next &&
                 loops[first] == loops[static_cast<std::size_t>(&line - lines.data())];
        });
    return cuts || loops[first] != loops[last] || loops[first] != loops[i] ? stay
                                                                           : std::pair{first, last};
  };
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (lines[i].kind != LineKind::Goto)
      continue;
    auto [first, last] = movable(i, lines[i].label);
    if (first == none && i > 0 && lines[i - 1].kind == LineKind::If && !lines[i - 1].guard &&
        code.conditions[lines[i - 1].condition].glue == Glue::None) {
      // Place the other path of a test next.
      std::tie(first, last) = movable(i, lines[i - 1].label);
      if (first != none) {
        auto& relation = code.conditions[lines[i - 1].condition].first;
        relation.comparison = opposite(relation.comparison);
        std::swap(lines[i - 1].label, lines[i].label);
      }
    }
    if (first == none)
      continue;
    lines[i].kind = LineKind::Nothing;
    const auto begin = lines.begin();
    if (first > i)
      std::rotate(begin + i, begin + first, begin + last + 1);
    else
      std::rotate(begin + first, begin + last + 1, begin + i);
    at = lines_of_labels(code);
    loops = loops_of_lines(code);
    changed = true;
  }
  return changed;
}

std::vector<std::uint32_t> lines_of_labels(const Code& code) {
  std::vector<std::uint32_t> lines(code.labels, none);
  for (std::uint32_t i = 0; i < code.lines.size(); ++i)
    if (code.lines[i].kind == LineKind::Label)
      lines[code.lines[i].label] = i;
  return lines;
}

std::vector<std::uint32_t> tidy(Code& code) {
  auto named = names_of_labels(code);
  std::erase_if(code.lines, [&](const CodeLine& line) {
    return line.kind == LineKind::Nothing ||
           (line.kind == LineKind::Label && named[line.label] == 0);
  });
  return named;
}

bool clean_jumps(Code& code) {
  return Cleaner(code).run();
}

} // namespace orb::structured
