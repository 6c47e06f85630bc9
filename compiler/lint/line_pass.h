#pragma once

#include "compiler/analyse/flow.h"
#include "compiler/analyse/reading.h"
#include "compiler/lint/lint_passes.h"

#include <cstdint>
#include <optional>
#include <span>

namespace orb::compiler {

/// A pass over the lines of code of a program, given by their index into Flow::code.
class LinePass {
public:
  LinePass(const Program& program, const Flow& flow, Findings& findings)
      : program_(program), flow_(flow), findings_(findings),
        size_(static_cast<std::uint32_t>(flow.code.size())) {}

protected:
  const StatementNode& statement_of(std::uint32_t code) const {
    return program_.statements[flow_.code[code].statement];
  }
  /// The statement of a line and those in its branches.
  std::span<const StatementNode> whole(std::uint32_t code) const {
    return program_.whole(statement_of(code));
  }
  std::uint32_t number_of(std::uint32_t code) const {
    return program_.lines[flow_.code[code].line].number;
  }

  /// True if the line has no branches.
  bool is_single(std::uint32_t code) const {
    const auto& statement = statement_of(code);
    return !statement.error && statement.then_branch == none;
  }
  /// True if the line has no branches and only the line below follows it.
  bool is_plain(std::uint32_t code) const {
    return is_single(code) && flow_.code[code].falls && flow_.jumps_of(flow_.code[code]).empty();
  }

  /// True if the statement assigns a system variable.
  bool sets(const StatementNode& statement, spec::Variable variable) const {
    if (statement.error || statement.kind != spec::Statement::Let)
      return false;
    const auto& set = program_.as<LetView>(statement).variable;
    return set.kind == ItemKind::System && static_cast<spec::Variable>(set.value) == variable;
  }
  enum class Waits : std::uint8_t { Allowed, None };
  /// The number assigned to a timer on the lines right above, with waits in between or without.
  std::optional<std::int32_t> set_above(spec::Variable timer, std::uint32_t code,
                                        Waits waits) const {
    constexpr std::uint32_t far = 8;
    for (auto i = code; i > 0 && code - i < far; --i) {
      const auto& above = statement_of(i - 1);
      const auto after = spec::info(above.kind).after;
      if ((i < code && flow_.code[i].target) || !is_plain(i - 1) ||
          (after != spec::After::Falls && (after != spec::After::Waits || waits == Waits::None)))
        return std::nullopt;
      if (sets(above, timer))
        return constant_in(program_, program_.as<LetView>(above).expression);
    }
    return std::nullopt;
  }

  /// A letter plus a number; no letter for any other expression.
  struct Shifted {
    std::uint32_t letter = none;
    std::int64_t by = 0;
  };
  Shifted shifted(const Item& item) const {
    if (const auto letter = letter_in(program_, item))
      return {*letter, 0};
    const auto nodes = nodes_of(program_, item);
    if (nodes.size() != 3 || nodes[0].kind != NodeKind::Letter ||
        nodes[1].kind != NodeKind::Number || nodes[1].overflow || nodes[2].kind != NodeKind::Binary)
      return {};
    const auto op = static_cast<spec::Operator>(nodes[2].what);
    return op == spec::Operator::Add        ? Shifted{nodes[0].what, nodes[1].value}
           : op == spec::Operator::Subtract ? Shifted{nodes[0].what, -std::int64_t{nodes[1].value}}
                                            : Shifted{};
  }
  /// The number that a statement adds to a letter: `A = A + 1`; no letter for any other statement.
  Shifted step_in(const StatementNode& statement) const {
    if (statement.error || statement.kind != spec::Statement::Let)
      return {};
    const auto let = program_.as<LetView>(statement);
    const auto step = shifted(let.expression);
    const bool adds = nodes_of(program_, let.expression).size() == 3 &&
                      let.variable.kind == ItemKind::Letter && let.variable.value == step.letter;
    return adds ? step : Shifted{};
  }

  /// True if an expression of a statement contains a letter.
  bool reads(const StatementNode& statement, std::uint32_t letter) const {
    for (auto n = statement.nodes_begin; n < statement.nodes_end; ++n)
      if (program_.nodes[n].kind == NodeKind::Letter && program_.nodes[n].what == letter)
        return true;
    return false;
  }

  static Span span_of(const Comparison& comparison) {
    return {comparison.left.span.begin, comparison.right.span.end};
  }

  const Program& program_;
  const Flow& flow_;
  Findings& findings_;
  std::uint32_t size_; ///< the number of lines of code
};

} // namespace orb::compiler
