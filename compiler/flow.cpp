#include "compiler/flow.h"

#include <algorithm>

namespace orb::compiler {
namespace {

class Reader {
public:
  explicit Reader(const Program& program) : program_(program) {}

  Flow read() {
    collect_lines();
    for (std::uint32_t i = 0; i < flow_.code.size(); ++i) {
      auto& code = flow_.code[i];
      code.jumps_begin = static_cast<std::uint32_t>(flow_.jumps.size());
      const auto& statement = program_.statements[code.statement];
      code.falls = statement.then_branch != none ? follow_branches(statement) : follow(statement);
      code.jumps_end = static_cast<std::uint32_t>(flow_.jumps.size());
    }
    return std::move(flow_);
  }

private:
  void collect_lines() {
    flow_.code.reserve(program_.lines.size());
    flow_.numbers.reserve(program_.lines.size());
    bool sorted = true;
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i) {
      const auto& line = program_.lines[i];
      const auto index =
          line.has_statement() ? static_cast<std::uint32_t>(flow_.code.size()) : none;
      if (line.has_number()) {
        sorted = sorted && (flow_.numbers.empty() || flow_.numbers.back().number < line.number);
        flow_.numbers.push_back({line.number, i, index});
      }
      if (line.has_statement()) {
        auto& code = flow_.code.emplace_back();
        code.line = i;
        code.statement = line.statement;
      }
    }
    if (!sorted)
      std::stable_sort(flow_.numbers.begin(), flow_.numbers.end(),
                       [](const auto& a, const auto& b) { return a.number < b.number; });
  }

  bool follow_branches(const StatementNode& statement) {
    const bool then_falls = follow(program_.statements[statement.then_branch]);
    if (statement.else_branch == none)
      return true;
    const bool else_falls = follow(program_.statements[statement.else_branch]);
    return then_falls || else_falls;
  }

  /// Notes where a statement jumps; returns whether the next line can follow.
  bool follow(const StatementNode& statement) {
    if (statement.error)
      return true; // once corrected it goes on; lint asks may_steer() first
    const auto after = spec::info(statement.kind).after;
    const bool calls =
        statement.kind == spec::Statement::Gosub || statement.spelling == Spelling::OnGosub;
    if (after == spec::After::Steers || after == spec::After::Jumps)
      add_targets(statement, calls);
    return calls || (after != spec::After::Jumps && after != spec::After::Ends);
  }

  void add_targets(const StatementNode& statement, bool call) {
    for (const auto& item : program_.items_of(statement)) {
      if (item.kind != ItemKind::Target)
        continue;
      Flow::Jump jump;
      jump.item = static_cast<std::uint32_t>(&item - program_.items.data());
      jump.call = call;
      if (const auto* number = flow_.find(item.value))
        jump.to = number->code;
      if (jump.to != none) {
        flow_.code[jump.to].target = true;
        flow_.code[jump.to].called = flow_.code[jump.to].called || call;
      }
      flow_.jumps.push_back(jump);
    }
  }

  const Program& program_;
  Flow flow_;
};

} // namespace

const Flow::Number* Flow::find(std::uint32_t number) const {
  const auto at = std::lower_bound(numbers.begin(), numbers.end(), number,
                                   [](const auto& row, std::uint32_t n) { return row.number < n; });
  return at != numbers.end() && at->number == number ? &*at : nullptr;
}

Flow read_flow(const Program& program) {
  return Reader(program).read();
}

} // namespace orb::compiler
