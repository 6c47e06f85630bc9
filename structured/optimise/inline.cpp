#include "structured/optimise/inline.h"

#include "structured/analyse/flow.h"
#include "structured/analyse/sizes.h"

#include <algorithm>
#include <utility>

namespace orb::structured {
namespace {

class Inliner {
public:
  explicit Inliner(Code& code)
      : code_(code), sites_(code.routines.size(), 0), bytes_(code.routines.size(), 0),
        call_bytes_(code.routines.size(), 0), results_(code.routines.size(), none),
        result_bytes_(code.routines.size(), 0), tested_(code.routines.size(), 0) {}

  bool run() {
    find_results();
    std::uint32_t set = 0; // bytes of assignments just before the call, such as parameters
    for (std::uint32_t i = 0; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Gosub && is_tested(i + 1, results_[line.variable])) {
        call_bytes_[line.variable] += bytes_of(code_, code_.lines[i + 1]);
        ++tested_[line.variable];
      }
      if (const auto routine = callee_of(line); routine != none) {
        ++sites_[routine];
        call_bytes_[routine] += call_bytes + set;
      }
      set = line.kind == LineKind::Let ? set + line_bytes + 2 : 0;
      if (line.kind != LineKind::Return)
        bytes_[line.routine] += bytes_of(code_, line);
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
    constexpr std::uint32_t slack = 16; // bytes that fewer executed lines may cost
    const auto sites = sites_[routine];
    if (sites == 0)
      return false;
    return sites == 1 || sites * bytes_[routine] <= call_bytes_[routine] + bytes_[routine] +
                                                        return_bytes + slack +
                                                        tested_[routine] * result_bytes_[routine];
  }

  /// Finds routines that set the same variable to a number at each return: if it is only tested,
  /// the call becomes jumps.
  void find_results() {
    std::vector<bool> others(code_.routines.size(), false);
    for (std::uint32_t i = 1; i < code_.lines.size(); ++i) {
      const auto& line = code_.lines[i];
      const auto& above = code_.lines[i - 1];
      if (line.kind != LineKind::Return)
        continue;
      auto& result = results_[line.routine];
      if (above.kind != LineKind::Let || !code_.is_number(above.term) ||
          (result != none && result != above.variable))
        others[line.routine] = true;
      result = above.variable;
      result_bytes_[line.routine] += bytes_of(code_, above);
    }
    for (std::size_t routine = 0; routine < others.size(); ++routine)
      if (others[routine])
        results_[routine] = none;
  }

  bool is_tested(std::uint32_t i, std::uint32_t variable) const {
    if (i >= code_.lines.size() || code_.lines[i].kind != LineKind::If || variable == none)
      return false;
    const auto& relation = code_.conditions[code_.lines[i].condition].first;
    const auto& left = code_.terms[relation.left];
    return left.kind == TermKind::Variable && left.left == variable &&
           code_.is_number(relation.right);
  }

  /// True if a sub calls no other sub that will be inlined: callees go first, callers in a later
  /// round.
  bool is_leaf(std::uint32_t routine) const {
    return std::none_of(code_.lines.begin(), code_.lines.end(), [&](const CodeLine& line) {
      const auto callee = callee_of(line);
      return line.routine == routine && callee != none && is_worth(callee);
    });
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
    for (const auto& one : body) {
      auto line = copy_line(code_, one);
      line.routine = call.routine;
      if (line.kind == LineKind::Return) {
        line.kind = LineKind::Goto;
        line.label = end;
      } else {
        if (line.label != none && line.kind != LineKind::Gosub)
          line.label = renamed(line.label);
        if (line.kind == LineKind::On)
          for (auto i = line.parts_begin; i < line.parts_end; ++i)
            code_.parts[i].value = renamed(code_.parts[i].value);
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

  Code& code_;
  std::vector<std::uint32_t> sites_;      ///< of each routine: its calls
  std::vector<std::uint32_t> bytes_;      ///< of each routine
  std::vector<std::uint32_t> call_bytes_; ///< of all calls of each routine
  std::vector<std::uint32_t> results_;    ///< of each routine: the variable of its result, or none
  std::vector<std::uint32_t> result_bytes_; ///< of the lines that set it
  std::vector<std::uint32_t> tested_;       ///< of each routine: calls with a test below
  std::vector<std::uint32_t> labels_;
};

} // namespace

bool inline_calls(Code& code) {
  return Inliner(code).run();
}

} // namespace orb::structured
