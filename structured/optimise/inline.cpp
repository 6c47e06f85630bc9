#include "structured/optimise/inline.h"

#include "structured/optimise/flow.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

// Rough sizes in bytes: they only choose between two right programs.
constexpr std::uint32_t line_bytes = 5;   // its number, the blank and the line end
constexpr std::uint32_t call_bytes = 10;  // `12 gosub 34`
constexpr std::uint32_t return_bytes = 9; // `12 return`

class Inliner {
public:
  explicit Inliner(Code& code)
      : code_(code), sites_(code.routines.size(), 0), listed_(code.routines.size(), false),
        bytes_(code.routines.size(), 0), call_bytes_(code.routines.size(), 0) {}

  bool run() {
    std::uint32_t set = 0; // bytes of lines that set variables just before, such as parameters
    for (const auto& line : code_.lines) {
      set = line.kind == LineKind::Let     ? set + line_bytes + 2
            : line.kind == LineKind::Gosub ? set
                                           : 0;
      each_callee(code_, line, [&](std::uint32_t routine) {
        ++sites_[routine];
        call_bytes_[routine] += call_bytes + std::exchange(set, 0);
        listed_[routine] = listed_[routine] || line.kind == LineKind::OnGosub;
      });
      if (line.kind != LineKind::Return)
        bytes_[line.routine] += bytes_of(line);
    }
    bool any = false;
    for (std::uint32_t routine = 1; routine < code_.routines.size(); ++routine)
      if (code_.routines[routine] != none && is_worth(routine) && is_leaf(routine)) {
        put(routine);
        any = true;
      }
    return any;
  }

private:
  bool is_worth(std::uint32_t routine) const {
    const auto sites = sites_[routine];
    if (sites == 0 || listed_[routine])
      return false;
    return sites == 1 ||
           sites * bytes_[routine] <= call_bytes_[routine] + bytes_[routine] + return_bytes;
  }

  /// Whether a sub calls no other that is written into it, too: callees first, and callers in a
  /// later round.
  bool is_leaf(std::uint32_t routine) const {
    return std::none_of(code_.lines.begin(), code_.lines.end(), [&](const CodeLine& line) {
      bool calls = false;
      if (line.routine == routine)
        each_callee(code_, line, [&](std::uint32_t callee) { calls = calls || is_worth(callee); });
      return calls;
    });
  }

  std::uint32_t bytes_of(const CodeLine& line) const {
    std::uint32_t bytes = line_bytes;
    each_root(code_, line,
              [&](std::uint32_t root) { bytes += 3 * std::uint32_t{code_.terms[root].size} / 2; });
    switch (line.kind) {
    case LineKind::Nothing:
    case LineKind::Label: return 0;
    case LineKind::If: return bytes + 12;
    case LineKind::Print:
    case LineKind::Do:
      for (auto i = line.parts_begin; i < line.parts_end; ++i)
        bytes += code_.parts[i].text.size() + 1;
      return bytes + 5;
    case LineKind::Let:
    case LineKind::SetElement:
    case LineKind::SetSystem: return bytes + 2;
    case LineKind::Goto:
    case LineKind::For:
    case LineKind::Next:
    case LineKind::Gosub:
    case LineKind::Return:
    case LineKind::Switch:
    case LineKind::On:
    case LineKind::OnGosub:
    case LineKind::Choice: return bytes + 7;
    }
    return bytes;
  }

  void put(std::uint32_t routine) {
    std::vector<CodeLine> body;
    std::vector<CodeLine> lines;
    for (const auto& line : code_.lines)
      (line.routine == routine ? body : lines).push_back(line);
    code_.lines.clear();
    for (const auto& line : lines) {
      if (line.kind == LineKind::Gosub && line.variable == routine)
        copy(body, line);
      else
        code_.lines.push_back(line);
    }
    code_.routines[routine] = none;
  }

  void copy(const std::vector<CodeLine>& body, const CodeLine& call) {
    labels_.assign(code_.labels, none);
    const auto end = code_.labels++;
    code_.lines.push_back(call);
    code_.lines.back().kind = LineKind::Goto; // the body need not begin with its entry
    code_.lines.back().label = renamed(call.label);
    for (auto line : body) {
      line.routine = call.routine;
      if (line.kind == LineKind::Return) {
        line.kind = LineKind::Goto;
        line.label = end;
      } else {
        if (line.label != none && line.kind != LineKind::Gosub)
          line.label = renamed(line.label);
        copy_terms(line);
      }
      code_.lines.push_back(line);
    }
    code_.lines.push_back(call);
    code_.lines.back().kind = LineKind::Label;
    code_.lines.back().label = end;
  }

  std::uint32_t renamed(std::uint32_t label) {
    if (label >= labels_.size())
      return label;
    if (labels_[label] == none)
      labels_[label] = code_.labels++;
    return labels_[label];
  }

  /// What is found out about a copy must not be believed of the others.
  void copy_terms(CodeLine& line) {
    if (line.kind == LineKind::If) {
      code_.conditions.push_back(Condition{code_.conditions[line.condition]});
      line.condition = static_cast<std::uint32_t>(code_.conditions.size()) - 1;
    }
    if (line.parts_end > line.parts_begin && line.kind != LineKind::Switch) {
      const auto begin = static_cast<std::uint32_t>(code_.parts.size());
      for (auto i = line.parts_begin; i < line.parts_end; ++i)
        code_.parts.push_back(Part{code_.parts[i]});
      line.parts_begin = begin;
      line.parts_end = static_cast<std::uint32_t>(code_.parts.size());
      if (line.kind == LineKind::On)
        for (auto i = line.parts_begin; i < line.parts_end; ++i)
          code_.parts[i].value = renamed(code_.parts[i].value);
    }
    each_root(code_, line, [&](std::uint32_t& root) { root = code_.copy(root); });
  }

  Code& code_;
  std::vector<std::uint32_t> sites_;      ///< of each routine: how often it is called
  std::vector<bool> listed_;              ///< of each routine: an `on … gosub` calls it
  std::vector<std::uint32_t> bytes_;      ///< of each routine
  std::vector<std::uint32_t> call_bytes_; ///< of all calls of each routine
  std::vector<std::uint32_t> labels_;
};

} // namespace

bool inline_calls(Code& code) {
  return Inliner(code).run();
}

} // namespace orb::structured
