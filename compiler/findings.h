#pragma once

#include "base/diagnostic.h"
#include "compiler/flow.h"
#include "compiler/program.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace orb::compiler {

/// Collects what the passes of the linter find. Private to compiler/.
class Findings {
public:
  explicit Findings(const Program& program) : program_(program) {}

  /// Adds a finding on line `line` (an index); the reference is good until the next call.
  Diagnostic& add(const Rule& rule, std::uint32_t line, Span span, std::string message,
                  std::string help = {}) {
    auto& diagnostic = all_.emplace_back(finding(rule, span, std::move(message), std::move(help)));
    if (line < program_.lines.size() && program_.lines[line].has_number())
      diagnostic.basic_line = program_.lines[line].number;
    return diagnostic;
  }
  void add(Diagnostic diagnostic) { all_.push_back(std::move(diagnostic)); }

  std::vector<Diagnostic>& all() { return all_; }

  /// Gives the findings that name no line yet the number of the line they stand in.
  void place() {
    for (auto& d : all_) {
      const auto next = std::upper_bound(
          program_.lines.begin(), program_.lines.end(), d.span.begin,
          [](std::uint32_t offset, const Line& line) { return offset < line.span.begin; });
      if (!d.basic_line && next != program_.lines.begin() && next[-1].has_number())
        d.basic_line = next[-1].number;
    }
  }

private:
  const Program& program_;
  std::vector<Diagnostic> all_;
};

/// A fix of one edit.
inline Fix single_fix(std::string title, Span span, std::string text,
                      Safety safety = Safety::Safe) {
  return Fix{std::move(title), {Edit{span, std::move(text)}}, safety};
}

/// The rules about jumps, loops and subroutines.
void lint_flow(const Program& program, const Flow& flow, Findings& findings);

} // namespace orb::compiler
