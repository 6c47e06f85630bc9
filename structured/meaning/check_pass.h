#pragma once

#include "compiler/analyse/range.h"
#include "compiler/lint/sensor_tests.h"
#include "compiler/lint/sums.h"
#include "compiler/text/rules.h"
#include "compiler/text/texts.h"
#include "spec/limits.h"
#include "structured/meaning/check.h"
#include "structured/text/link_blocks.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace orb::structured {

/// A check of a program whose names are resolved.
class CheckPass {
public:
  CheckPass(Program& program, const Names& names) : program_(program), names_(names) {}

protected:
  Diagnostic& report(const Rule& rule, Span span, Message message, Message help = {}) {
    return program_.diagnostics.emplace_back(
        finding(rule, span, std::move(message), std::move(help)));
  }
  Diagnostic& report(const Rule& rule, Span span, compiler::FindingTexts said) {
    return report(rule, span, std::move(said.message), std::move(said.help));
  }

  const Statement& at(std::uint32_t i) const { return program_.statements[i]; }
  const Item& item(const Statement& statement, std::uint32_t n) const {
    return program_.items[statement.items_begin + n];
  }

  static std::uint32_t size(const Statement& statement) {
    return statement.items_end - statement.items_begin;
  }

  std::optional<Constant> value_of(const Item& part) const {
    return evaluate(program_, names_, part.value);
  }

  std::uint32_t variable_of(const Statement& loop) const {
    return names_.of_node[item(loop, 0).value];
  }

  /// True if a name in an expression is unknown, which is already reported.
  bool names_unknown(std::uint32_t root) const {
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      if (program_.nodes[n].kind == NodeKind::Name && names_.of_node[n] == none)
        return true;
    return false;
  }

  /// Reads a comparison with a number; nothing for any other node.
  std::optional<compiler::Bound> bound_of(std::uint32_t relation) const {
    if (program_.nodes[relation].kind != NodeKind::Relation) // otherwise nothing may precede it
      return std::nullopt;
    const auto number = evaluate(program_, names_, relation - 1);
    if (!number)
      return std::nullopt;
    return compiler::Bound{static_cast<Comparison>(program_.nodes[relation].what), number->value};
  }

  /// The statement `after`, if it is unreachable because control never passes `i`; null if it is
  /// reachable or has no effect.
  const Statement* never_reached(std::uint32_t i, std::uint32_t after) const {
    if (after >= program_.statements.size() || names_.routine_of[after] != names_.routine_of[i] ||
        at(after).depth != at(i).depth)
      return nullptr;
    const auto kind = at(after).kind;
    const bool runs = kind != Kind::Label && kind != Kind::Local && kind != Kind::Broken &&
                      !declares(kind) && !parts_block(kind) && !closes_block(kind) &&
                      (kind != Kind::Robot || at(after).robot != spec::Statement::Data);
    return runs ? &at(after) : nullptr;
  }

  Program& program_;
  const Names& names_;
};

// The checks, in the order in which they run.

void check_expressions(Program& program, const Names& names);
void check_statements(Program& program, const Names& names);
void check_jumps(Program& program, const Names& names);
/// These need a program without errors.
void check_names(Program& program, const Names& names);
void check_meant(Program& program, const Names& names);
void check_loops(Program& program, const Names& names);

} // namespace orb::structured
