#include "structured/optimise/sink.h"

#include "spec/limits.h"
#include "structured/analyse/flow.h"
#include "structured/analyse/sizes.h"
#include "structured/optimise/jumps.h"

namespace orb::structured {
namespace {

constexpr std::uint32_t most_bytes = 19; ///< of a line that is written twice

class Sinker {
public:
  explicit Sinker(Code& code) : code_(code), named_(tidy(code)), flow_(read_flow(code)) {}

  void run() {
    const auto liveness = read_liveness(code_, flow_);
    std::vector<std::uint64_t> live;
    for (std::uint32_t b = 0; b + 2 < flow_.blocks.size(); ++b) {
      const auto i = flow_.blocks[b].end - 1;
      if (!is_diamond(i))
        continue;
      const auto join = flow_.block_of_label[code_.lines[i + 2].label];
      const auto out = liveness.out[join];
      live.assign(out.begin(), out.end());
      for (auto n = flow_.blocks[join].end; n-- > i + 7;)
        step_back(code_, flow_, liveness, code_.lines[n], live);
      sink(i, live);
    }
    tidy(code_);
  }

private:
  /// if c goto L1; v = a; goto L2; L1: v = b; L2: s
  bool is_diamond(std::uint32_t i) const {
    const auto& lines = code_.lines;
    return i + 7 < lines.size() && lines[i].kind == LineKind::If && sets(i + 1) &&
           lines[i + 2].kind == LineKind::Goto && lines[i + 3].kind == LineKind::Label &&
           lines[i + 3].label == lines[i].label && named_[lines[i].label] == 1 && sets(i + 4) &&
           lines[i + 1].variable == lines[i + 4].variable && lines[i + 5].kind == LineKind::Label &&
           lines[i + 5].label == lines[i + 2].label && named_[lines[i + 5].label] == 1 &&
           fits(lines[i + 6]);
  }

  bool sets(std::uint32_t i) const {
    const auto& line = code_.lines[i];
    return line.kind == LineKind::Let && line.variable != index_variable &&
           !code_.variables[line.variable].kept && is_pure(effects_of(code_, line));
  }

  bool fits(const CodeLine& line) const {
    return fits_arm(line) && bytes_of(code_, line) <= most_bytes;
  }

  void sink(std::uint32_t i, std::span<const std::uint64_t> live) {
    const auto variable = code_.lines[i + 1].variable;
    const auto line = code_.lines[i + 6];
    bool writes = false;
    each_write(code_, line, [&](std::uint32_t v) { writes = writes || v == variable; });
    std::uint32_t reads = 0;
    each_line_read(code_, line, [&](std::uint32_t v) { reads += v == variable ? 1 : 0; });
    if (reads != 1 || (!writes && contains(live, variable)))
      return;
    // One line of the robot speaks for one that can stop the program.
    if (may_fault(code_, line) && !is_pure(effects_of(code_, code_.lines[i])))
      return;
    auto below = copy_line(code_, line);
    auto there = copy_line(code_, line);
    if (!put(below, variable, code_.lines[i + 1].term) ||
        !put(there, variable, code_.lines[i + 4].term))
      return;
    code_.lines[i + 1] = below;
    code_.lines[i + 4] = there;
    code_.lines[i + 6].kind = LineKind::Nothing;
  }

  bool put(CodeLine& line, std::uint32_t variable, std::uint32_t term) {
    bool fits = true;
    each_root(code_, line, [&](std::uint32_t& root) {
      root = replaced(root, variable, term);
      fits = fits && code_.terms[root].levels <= spec::value_of(spec::Limit::ExpressionLevels);
    });
    for (auto n = line.parts_begin; n < line.parts_end; ++n)
      if (code_.parts[n].kind == PartKind::Term && code_.is_number(code_.parts[n].value))
        code_.parts[n].range = compiler::Range::only(code_.terms[code_.parts[n].value].value);
    return fits;
  }

  std::uint32_t replaced(std::uint32_t root, std::uint32_t variable, std::uint32_t term) {
    const auto node = code_.terms[root];
    if (node.kind == TermKind::Variable)
      return node.left == variable ? term : root;
    if (node.kind != TermKind::Binary && node.kind != TermKind::Call)
      return root;
    const auto left = replaced(node.left, variable, term);
    if (node.kind == TermKind::Call)
      return left == node.left ? root : code_.call(static_cast<spec::Function>(node.what), left);
    const auto right = replaced(node.right, variable, term);
    return left == node.left && right == node.right
               ? root
               : code_.binary(static_cast<spec::Operator>(node.what), left, right);
  }

  Code& code_;
  std::vector<std::uint32_t> named_; ///< of each label: how often
  Flow flow_;
};

} // namespace

void sink_into_arms(Code& code) {
  Sinker(code).run();
}

} // namespace orb::structured
