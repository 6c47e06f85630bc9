#include "structured/flow.h"

#include <algorithm>

namespace orb::structured {
namespace {

bool sets_element(const Code& code, const CodeLine& line) {
  if (line.kind == LineKind::SetElement)
    return true;
  if (line.kind == LineKind::Do)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code.parts[i].kind == PartKind::Element)
        return true;
  return false;
}

bool ends_block(const CodeLine& line) {
  switch (line.kind) {
  case LineKind::Goto:
  case LineKind::If:
  case LineKind::Next:
  case LineKind::Return:
  case LineKind::Switch:
  case LineKind::On: return true;
  case LineKind::Do: return !falls_through(line);
  case LineKind::Nothing:
  case LineKind::Label:
  case LineKind::Let:
  case LineKind::SetElement:
  case LineKind::SetSystem:
  case LineKind::For:
  case LineKind::Gosub:
  case LineKind::OnGosub:
  case LineKind::Print:
  case LineKind::Choice: return false;
  }
  return false;
}

void find_blocks(const Code& code, Flow& flow) {
  const auto size = static_cast<std::uint32_t>(code.lines.size());
  flow.block_of_label.assign(code.labels, none);
  for (std::uint32_t i = 0; i < size;) {
    Block block;
    block.begin = i;
    const auto index = static_cast<std::uint32_t>(flow.blocks.size());
    for (; i < size; ++i) {
      const auto& line = code.lines[i];
      if (line.kind == LineKind::Label) {
        // Only labels and removed lines may stand before it in its block.
        const bool first = std::all_of(
            code.lines.begin() + block.begin, code.lines.begin() + i, [](const CodeLine& before) {
              return before.kind == LineKind::Label || before.kind == LineKind::Nothing;
            });
        if (!first)
          break;
        flow.block_of_label[line.label] = index;
      } else if (ends_block(line)) {
        ++i;
        break;
      }
    }
    block.end = i;
    flow.blocks.push_back(block);
  }
}

void find_successors(const Code& code, Flow& flow) {
  const auto count = static_cast<std::uint32_t>(flow.blocks.size());
  for (std::uint32_t b = 0; b < count; ++b) {
    auto& block = flow.blocks[b];
    block.successors_begin = static_cast<std::uint32_t>(flow.successors.size());
    const auto& last = code.lines[block.end - 1];
    if (falls_through(last) && b + 1 < count)
      flow.successors.push_back(b + 1);
    each_target(code, last, [&](std::uint32_t label) {
      if (flow.block_of_label[label] != none)
        flow.successors.push_back(flow.block_of_label[label]);
    });
    block.successors_end = static_cast<std::uint32_t>(flow.successors.size());
  }
}

/// The routines that a line calls.
template <typename Visit>
void each_callee(const Code& code, const CodeLine& line, Visit visit) {
  if (line.kind == LineKind::Gosub)
    visit(line.variable);
  if (line.kind == LineKind::OnGosub)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      visit(code.parts[i].text.begin);
}

void find_touched(const Code& code, Flow& flow) {
  const auto routines = code.routines.size();
  flow.written = VariableSets(routines, code.variables.size());
  flow.touched = VariableSets(routines, code.variables.size());
  flow.sets_elements.assign(routines, false);
  for (const auto& line : code.lines) {
    each_write(code, line, [&](std::uint32_t v) {
      insert(flow.written[line.routine], v);
      insert(flow.touched[line.routine], v);
    });
    each_line_read(code, line, [&](std::uint32_t v) { insert(flow.touched[line.routine], v); });
    if (sets_element(code, line))
      flow.sets_elements[line.routine] = true;
  }
  for (bool changed = routines > 1; changed;) {
    changed = false;
    for (const auto& line : code.lines)
      each_callee(code, line, [&](std::uint32_t callee) {
        changed = unite(flow.written[line.routine], flow.written[callee]) || changed;
        changed = unite(flow.touched[line.routine], flow.touched[callee]) || changed;
        if (flow.sets_elements[callee] && !flow.sets_elements[line.routine])
          changed = flow.sets_elements[line.routine] = true;
      });
  }
}

} // namespace

bool unite(std::span<std::uint64_t> set, std::span<const std::uint64_t> from) {
  std::uint64_t changed = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    changed |= from[i] & ~set[i];
    set[i] |= from[i];
  }
  return changed != 0;
}

bool falls_through(const CodeLine& line) {
  if (line.kind == LineKind::Do)
    return line.robot != spec::Statement::End && line.robot != spec::Statement::Reset;
  return line.kind != LineKind::Goto && line.kind != LineKind::Return &&
         line.kind != LineKind::Switch && line.kind != LineKind::On;
}

Flow read_flow(const Code& code) {
  Flow flow;
  find_blocks(code, flow);
  find_successors(code, flow);
  flow.entries.assign(code.routines.size(), none);
  if (!flow.blocks.empty())
    flow.entries[0] = 0;
  for (std::size_t r = 1; r < code.routines.size(); ++r)
    if (code.routines[r] != none)
      flow.entries[r] = flow.block_of_label[code.routines[r]];
  find_touched(code, flow);
  return flow;
}

void step_back(const Code& code, const Flow& flow, const Liveness& liveness, const CodeLine& line,
               std::span<std::uint64_t> live) {
  each_write(code, line, [&](std::uint32_t v) { remove(live, v); });
  bool first = true;
  each_callee(code, line, [&](std::uint32_t callee) {
    const auto touched = flow.touched[callee];
    const auto entry = flow.entries[callee];
    // Of several that may be called, none surely sets a variable.
    if (first && line.kind == LineKind::Gosub)
      for (std::size_t i = 0; i < live.size(); ++i)
        live[i] &= ~touched[i];
    first = false;
    if (entry != none)
      unite(live, liveness.in[entry]);
  });
  each_line_read(code, line, [&](std::uint32_t v) { insert(live, v); });
}

Liveness read_liveness(const Code& code, const Flow& flow) {
  const auto variables = code.variables.size();
  const auto routines = code.routines.size();
  Liveness liveness;
  liveness.in = VariableSets(flow.blocks.size(), variables);
  liveness.out = VariableSets(flow.blocks.size(), variables);
  liveness.across = VariableSets(routines, variables);
  liveness.at_return = VariableSets(routines, variables);
  std::vector<std::uint64_t> live(liveness.in.words());
  for (bool changed = true; changed;) {
    changed = false;
    for (auto b = flow.blocks.size(); b-- > 0;) {
      const auto& block = flow.blocks[b];
      const auto out = liveness.out[b];
      for (const auto next : flow.successors_of(block))
        unite(out, liveness.in[next]);
      const auto& last = code.lines[block.end - 1];
      if (last.kind == LineKind::Return)
        unite(out, liveness.at_return[last.routine]);
      std::copy(out.begin(), out.end(), live.begin());
      for (auto i = block.end; i-- > block.begin;) {
        const auto& line = code.lines[i];
        each_callee(code, line, [&](std::uint32_t callee) {
          const auto touched = flow.touched[callee];
          std::vector<std::uint64_t> behind(live.size());
          std::vector<std::uint64_t> beside(live.size());
          for (std::size_t w = 0; w < live.size(); ++w) {
            behind[w] = live[w] & touched[w];
            beside[w] = live[w] & ~touched[w];
          }
          changed = unite(liveness.at_return[callee], behind) || changed;
          changed = unite(liveness.across[callee], beside) || changed;
          changed = unite(liveness.across[callee], liveness.across[line.routine]) || changed;
        });
        step_back(code, flow, liveness, line, live);
      }
      changed = unite(liveness.in[b], live) || changed;
    }
  }
  return liveness;
}

} // namespace orb::structured
