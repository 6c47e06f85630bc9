#include "compiler/analyse/flow.h"

#include <algorithm>
#include <numeric>

namespace orb::compiler {
namespace {

class FlowReader {
public:
  explicit FlowReader(const Program& program) : program_(program) {}

  Flow read() {
    flow_.code.reserve(program_.lines.size());
    flow_.numbers.reserve(program_.lines.size());
    flow_.jumps.reserve(program_.lines.size());
    for (std::uint32_t i = 0; i < program_.lines.size(); ++i)
      read_line(i);
    if (!flow_.orderly)
      std::stable_sort(flow_.numbers.begin(), flow_.numbers.end(),
                       [](const auto& a, const auto& b) { return a.number < b.number; });
    find_targets();
    sort_places();
    return std::move(flow_);
  }

private:
  void read_line(std::uint32_t index) {
    const auto& line = program_.lines[index];
    if (line.has_number()) {
      flow_.orderly = flow_.orderly && last_ < line.number && line.has_statement();
      last_ = line.number;
      const auto code = line.has_statement() ? size(flow_.code) : none;
      flow_.numbers.push_back({line.number, index, code});
    }
    if (!line.has_statement())
      return;
    auto& code = flow_.code.emplace_back();
    code.line = index;
    code.statement = line.statement;
    code.jumps_begin = size(flow_.jumps);
    const auto& statement = program_.statements[line.statement];
    code.falls = follow(statement, code);
    if (statement.then_branch != none)
      code.falls = follow_branches(statement, code);
    code.jumps_end = size(flow_.jumps);
  }

  template <typename T>
  static std::uint32_t size(const std::vector<T>& vector) {
    return static_cast<std::uint32_t>(vector.size());
  }

  bool follow_branches(const StatementNode& statement, Flow::Code& code) {
    const bool then_falls = follow(program_.statements[statement.then_branch], code);
    if (statement.else_branch == none)
      return true;
    const bool else_falls = follow(program_.statements[statement.else_branch], code);
    return then_falls || else_falls;
  }

  /// Records the effect of a statement on control flow and its jumps; returns true if the next line
  /// can follow.
  bool follow(const StatementNode& statement, Flow::Code& code) {
    if (statement.error)
      return true; // it falls through once corrected; lint asks may_steer() first
    ++flow_.begins[static_cast<std::size_t>(statement.kind) + 1];
    const auto& row = spec::info(statement.kind);
    switch (row.after) {
    case spec::After::Falls: return true;
    case spec::After::Waits: code.waits = true; return true;
    case spec::After::Ends: code.ends = true; return false;
    case spec::After::Steers:
    case spec::After::Jumps: break;
    }
    code.loops = code.loops || row.form == spec::Form::Loop || row.form == spec::Form::LoopEnd;
    const bool calls =
        statement.kind == spec::Statement::Gosub || statement.spelling == Spelling::OnGosub;
    add_targets(statement, calls);
    return calls || row.after != spec::After::Jumps;
  }

  void add_targets(const StatementNode& statement, bool call) {
    for (auto i = statement.items_begin; i < statement.items_end; ++i)
      if (program_.items[i].kind == ItemKind::Target)
        flow_.jumps.push_back({size(flow_.code) - 1, none, i, call});
  }

  void find_targets() {
    for (auto& jump : flow_.jumps) {
      const auto* number = flow_.find(program_.items[jump.item].value);
      if (number == nullptr || number->code == none)
        continue;
      jump.to = number->code;
      flow_.code[jump.to].target = true;
      flow_.code[jump.to].called = flow_.code[jump.to].called || jump.call;
    }
  }

  /// Prefix sum: turns the count of each kind into the start of the next kind.
  void sort_places() {
    std::partial_sum(flow_.begins.begin(), flow_.begins.end(), flow_.begins.begin());
    flow_.places.resize(flow_.begins.back());
    auto next = flow_.begins;
    std::uint32_t code = 0; // the statements in the branches of a line follow it directly
    for (std::uint32_t i = 0; i < program_.statements.size(); ++i) {
      const auto& statement = program_.statements[i];
      code += code + 1 < flow_.code.size() && flow_.code[code + 1].statement == i ? 1 : 0;
      if (!statement.error)
        flow_.places[next[static_cast<std::size_t>(statement.kind)]++] = {i, code};
    }
  }

  const Program& program_;
  Flow flow_;
  std::uint32_t last_ = 0; ///< line number
};

} // namespace

const Flow::Number* Flow::find(std::uint32_t number) const {
  const auto at = std::lower_bound(numbers.begin(), numbers.end(), number,
                                   [](const auto& row, std::uint32_t n) { return row.number < n; });
  return at != numbers.end() && at->number == number ? &*at : nullptr;
}

Flow read_flow(const Program& program) {
  return FlowReader(program).read();
}

} // namespace orb::compiler
