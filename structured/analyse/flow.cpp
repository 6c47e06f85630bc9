#include "structured/analyse/flow.h"

#include <algorithm>

namespace orb::structured {
namespace {

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
    bool empty = true; // the block has no instructions yet
    const auto index = static_cast<std::uint32_t>(flow.blocks.size());
    for (; i < size; ++i) {
      const auto& line = code.lines[i];
      if (line.kind == LineKind::Label) {
        if (!empty)
          break;
        flow.block_of_label[line.label] = index;
      } else if (ends_block(line)) {
        ++i;
        break;
      } else {
        empty = empty && line.kind == LineKind::Nothing;
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

void find_touched(const Code& code, Flow& flow) {
  const auto routines = code.routines.size();
  flow.written = VariableSets(routines, code.variables.size());
  flow.touched = VariableSets(routines, code.variables.size());
  flow.sets_elements.assign(routines, false);
  for (const auto& line : code.lines) {
    if (line.routine == 0)
      continue; // nobody calls the main program
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
    for (const auto& line : code.lines) {
      const auto callee = callee_of(line);
      if (callee == none)
        continue;
      changed = unite(flow.written[line.routine], flow.written[callee]) || changed;
      changed = unite(flow.touched[line.routine], flow.touched[callee]) || changed;
      if (flow.sets_elements[callee] && !flow.sets_elements[line.routine])
        changed = flow.sets_elements[line.routine] = true;
    }
  }
}

} // namespace

std::vector<std::uint32_t> names_of_labels(const Code& code) {
  std::vector<std::uint32_t> named(code.labels, 0);
  const auto name = [&](std::uint32_t label) { ++named[label]; };
  for (const auto& line : code.lines) {
    each_label(code, line, name);
    if (line.kind == LineKind::Choice)
      for (const auto branch : {line.term, line.end})
        if (branch != none)
          each_label(code, code.branches[branch], name);
  }
  return named;
}

bool sets_element(const Code& code, const CodeLine& line) {
  if (line.kind == LineKind::SetElement)
    return true;
  if (line.kind == LineKind::Do)
    for (auto i = line.parts_begin; i < line.parts_end; ++i)
      if (code.parts[i].kind == PartKind::Element)
        return true;
  return false;
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
  each_write(code, line, [&](std::uint32_t v) {
    if (!code.variables[v].kept)
      remove(live, v);
  });
  if (const auto callee = callee_of(line); callee != none) {
    const auto touched = flow.touched[callee];
    const auto entry = flow.entries[callee];
    for (std::size_t i = 0; i < live.size(); ++i)
      live[i] &= ~touched[i];
    if (entry != none)
      unite(live, liveness.in[entry]);
  }
  each_line_read(code, line, [&](std::uint32_t v) { insert(live, v); });
}

namespace {

/// Backward data-flow analysis: walks the blocks until no set of live variables grows. The effect
/// of a block without calls is precomputed; other blocks are walked line by line.
class LivenessReader {
public:
  LivenessReader(const Code& code, const Flow& flow, Counting counting)
      : code_(code), flow_(flow), counting_(counting), read_(flow.blocks.size(), variables()),
        written_(flow.blocks.size(), variables()), calls_(flow.blocks.size(), false) {
    liveness_.in = VariableSets(flow.blocks.size(), variables());
    liveness_.out = VariableSets(flow.blocks.size(), variables());
    liveness_.across = VariableSets(code.routines.size(), variables());
    liveness_.at_return = VariableSets(code.routines.size(), variables());
    live_.resize(liveness_.in.words());
    for (std::uint32_t v = 0; v < variables(); ++v)
      if (code.variables[v].kept)
        for (std::size_t b = 0; b < flow.blocks.size(); ++b)
          insert(liveness_.out[b], v);
  }

  Liveness run() {
    for (std::size_t b = 0; b < flow_.blocks.size(); ++b)
      sum_up(b);
    do {
      changed_ = false;
      for (auto b = flow_.blocks.size(); b-- > 0;)
        read_block(b);
    } while (changed_);
    return std::move(liveness_);
  }

private:
  std::size_t variables() const { return code_.variables.size(); }

  void step(const CodeLine& line, std::span<std::uint64_t> live) const {
    step_back(code_, flow_, liveness_, line, live);
    if (counting_ == Counting::SettingsToo && line.kind == LineKind::Let &&
        code_.is_number(line.term))
      insert(live, line.variable);
  }

  void sum_up(std::size_t b) {
    const auto& block = flow_.blocks[b];
    for (auto i = block.end; i-- > block.begin;) {
      const auto& line = code_.lines[i];
      if (line.kind == LineKind::Gosub) {
        calls_[b] = true;
        return;
      }
      step(line, read_[b]);
      each_write(code_, line, [&](std::uint32_t v) {
        if (!code_.variables[v].kept)
          insert(written_[b], v);
      });
    }
  }

  void read_block(std::size_t b) {
    const auto& block = flow_.blocks[b];
    const auto out = liveness_.out[b];
    for (const auto next : flow_.successors_of(block))
      unite(out, liveness_.in[next]);
    const auto& last = code_.lines[block.end - 1];
    if (last.kind == LineKind::Return)
      unite(out, liveness_.at_return[last.routine]);
    if (calls_[b])
      walk(block, out);
    else
      for (std::size_t w = 0; w < live_.size(); ++w)
        live_[w] = (out[w] & ~written_[b][w]) | read_[b][w];
    changed_ = unite(liveness_.in[b], live_) || changed_;
  }

  void walk(const Block& block, std::span<const std::uint64_t> out) {
    live_.assign(out.begin(), out.end());
    for (auto i = block.end; i-- > block.begin;) {
      const auto& line = code_.lines[i];
      if (const auto callee = callee_of(line); callee != none)
        call(line.routine, callee);
      step(line, live_);
    }
  }

  /// A variable that is live after a call is live at the callee's returns, or all through it.
  void call(std::uint32_t caller, std::uint32_t callee) {
    const auto touched = flow_.touched[callee];
    const auto at_return = liveness_.at_return[callee];
    const auto across = liveness_.across[callee];
    for (std::size_t w = 0; w < live_.size(); ++w) {
      const auto inside = live_[w] & touched[w];
      const auto beside = live_[w] & ~touched[w];
      changed_ = changed_ || (inside & ~at_return[w]) != 0 || (beside & ~across[w]) != 0;
      at_return[w] |= inside;
      across[w] |= beside;
    }
    changed_ = unite(across, liveness_.across[caller]) || changed_;
  }

  const Code& code_;
  const Flow& flow_;
  Counting counting_;
  Liveness liveness_;
  VariableSets read_;    ///< of each block without calls: live at its start, whatever follows
  VariableSets written_; ///< of each block without calls
  std::vector<bool> calls_;
  std::vector<std::uint64_t> live_;
  bool changed_ = false;
};

} // namespace

Liveness read_liveness(const Code& code, const Flow& flow, Counting counting) {
  return LivenessReader(code, flow, counting).run();
}

} // namespace orb::structured
