#if defined(ORB_NATIVE)
#include "vm/machine/native/register_plan.h"

#include "vm/machine/native/native.h"

#include <algorithm>
#include <array>
#include <utility>

namespace orb::vm::native {

using bytecode::Chunk;
using bytecode::Compiled;
using bytecode::Op;

Plan::Plan(const Chunk& chunk) : chunk_(chunk), heads_(chunk.code.size(), none) {
  match_loops();
  follow_ways();
  form_blocks();
  choose_homes();
}

void Plan::match_loops() {
  std::array<std::uint32_t, bytecode::first_temporary> last;
  last.fill(none);
  for (std::size_t i = 0; i < chunk_.lines.size(); ++i) {
    const bool tests = std::ranges::any_of(chunk_.instructions(i), [](const auto& instruction) {
      return bytecode::info(instruction.op).has_target();
    });
    for (std::uint32_t at = chunk_.begin(i); at < chunk_.begin(i + 1); ++at) {
      const auto& instruction = chunk_.code[at];
      if (instruction.op == Op::For)
        last[instruction.a] = tests || instruction.d < chunk_.first_constant() ? none : at;
      else if (instruction.op == Op::Next)
        heads_[at] = last[instruction.a];
    }
  }
}

bool Plan::can_be_machine_code(std::size_t index) const {
  bool changed = false;
  for (std::uint32_t at = chunk_.begin(index); at < chunk_.begin(index + 1); ++at) {
    const auto& instruction = chunk_.code[at];
    const auto& row = bytecode::info(instruction.op);
    if (row.compiled == Compiled::Never || (row.compiled == Compiled::Mostly && changed) ||
        (instruction.op == Op::Next && heads_[at] == none))
      return false;
    changed = changed || instruction.op == Op::StoreElement ||
              (row.operands[0] == 'w' && instruction.a < bytecode::first_temporary);
    if (instruction.ends_line || instruction.op == Op::Goto)
      changed = false; // what follows is reached only from a test
  }
  return true;
}

void Plan::follow_ways() {
  entered_.resize(chunk_.code.size());
  leads_away_.resize(chunk_.lines.size());
  leads_away_.push_back(true);
  for (std::size_t i = 0; i < chunk_.lines.size(); ++i)
    for (const auto& instruction : chunk_.instructions(i)) {
      const bool jumps = (instruction.ends_line && instruction.target != chunk_.begin(i + 1)) ||
                         instruction.op == Op::Target || instruction.op == Op::Gosub;
      if (jumps && bytecode::info(instruction.op).has_target())
        entered_[instruction.target] = leads_away_[i] = true;
      if (instruction.op == Op::For || instruction.op == Op::Next || instruction.op == Op::Return)
        leads_away_[i] = true;
    }
}

bool Plan::put_called_by(std::size_t line, std::vector<std::uint32_t> calls, std::size_t most) {
  calls.push_back(chunk_.begin(line + 1));
  const auto target = chunk_.code[chunk_.begin(line)].target;
  const auto first = std::ranges::lower_bound(chunk_.lines, target, {}, &bytecode::Line::begin);
  line = static_cast<std::size_t>(first - chunk_.lines.begin());
  for (; calls.size() <= Frames::gosub_depth && steps_.size() < most; ++line) {
    steps_.push_back({line, calls});
    if (first_op(line) == Op::Return)
      return true;
    const bool calls_on = first_op(line) == Op::Gosub && put_called_by(line, calls, most);
    if (!can_be_machine_code(line) || (leads_away_[line] && !calls_on))
      return false;
  }
  return false;
}

void Plan::form_blocks() {
  for (std::size_t i = 0; i < chunk_.lines.size(); ++i) {
    steps_.push_back({i, {}});
    const std::size_t size = steps_.size();
    const std::size_t most = std::min(size + NativeCode::longest_block, 4 * chunk_.lines.size());
    if (first_op(i) == Op::Gosub && !put_called_by(i, {}, most))
      steps_.resize(size);
  }
  steps_.push_back({chunk_.lines.size(), {}}); // the end of the program
  for (std::size_t i = steps_.size() - 1; i-- > 0;) {
    auto& step = steps_[i];
    const auto& next = steps_[i + 1];
    const bool away = next.calls.empty() && (entered_[chunk_.begin(next.line)] ||
                                             (step.calls.empty() && leads_away_[step.line]));
    if (can_be_machine_code(step.line))
      step.rest = away || next.rest == NativeCode::longest_block ? 1 : next.rest + 1;
  }
}

void Plan::choose_homes() {
  const std::size_t size = chunk_.code.size();
  std::vector<int> depth(size);
  for (std::uint32_t at = 0; at < size; ++at) {
    const auto& instruction = chunk_.code[at];
    const bool jumps = bytecode::info(instruction.op).has_target();
    for (auto inside = jumps ? instruction.target : heads_[at]; inside <= at; ++inside)
      ++depth[inside];
  }
  std::vector<std::uint64_t> uses(chunk_.register_count() + std::size_t{1});
  for (std::uint32_t at = 0; at < size; ++at) {
    const auto& instruction = chunk_.code[at];
    const auto& row = bytecode::info(instruction.op);
    const std::uint64_t weight = std::uint64_t{1} << 3 * std::min(depth[at], 6);
    const std::array values{instruction.a, instruction.b, instruction.c, instruction.d};
    for (std::size_t i = 0; i < values.size() && row.compiled != Compiled::Never; ++i) {
      if (row.operands[i] != '-' && row.operands[i] != 'n')
        uses[values[i]] += weight;
      if (row.operands[i] == 'p')
        uses[values[i] + 1u] += weight;
    }
    if (instruction.op == Op::LoadElement || instruction.op == Op::StoreElement)
      uses[bytecode::index_variable] += weight;
  }
  for (std::uint16_t index = 0; index < chunk_.first_constant(); ++index)
    if (uses[index] > 0)
      housed_.push_back(index);
  std::stable_sort(housed_.begin(), housed_.end(),
                   [&](auto x, auto y) { return uses[x] > uses[y]; });
  housed_.resize(std::min(housed_.size(), most_homes));
}

} // namespace orb::vm::native
#endif
