#pragma once

#include "base/diagnostic.h"
#include "base/units.h"
#include "spec/macro.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace orb::assembler {

/// Numbers are stored in thousandths: 1.5 is 1500.
inline constexpr std::int64_t whole = 1000;
/// Larger numbers are clamped to this: beyond every operand, and far below 2^63.
inline constexpr std::int64_t largest_number = 1'000'000'000;

/// An operand as written.
struct Value {
  enum class Kind : std::uint8_t { Number, Word, Text };
  Kind kind = Kind::Number;
  const Unit* unit = nullptr; ///< of a number; null: its operand's own
  bool is_known = true;       ///< true if the unit and decimals of a number are known
  Span span;
  Span name;                    ///< before the `=`; empty if the operand is unnamed
  std::int64_t thousandths = 0; ///< of a number, at most `largest_number`
};

/// A line with a statement.
struct Statement {
  enum class Kind : std::uint8_t { Command, Macro, Const, Raw, NoEnd };
  Kind kind = Kind::Command;
  const spec::MacroCommandInfo* info = nullptr; ///< of a command
  Span head;                                    ///< the mnemonic or directive
  Span span;                                    ///< including its operands
  std::uint32_t first = 0;                      ///< index of its first value in Program::values
  std::uint32_t count = 0;
};

/// A macro source file in flat arrays. Lines that do not parse are left out and reported in
/// `diagnostics`, one finding per line.
struct Program {
  std::string_view text; ///< the source, which must outlive this
  std::vector<Statement> statements;
  std::vector<Value> values;
  std::vector<Diagnostic> diagnostics;

  /// The text of a span.
  std::string_view text_of(Span span) const { return text.substr(span.begin, span.size()); }

  std::span<const Value> values_of(const Statement& statement) const {
    return std::span(values).subspan(statement.first, statement.count);
  }
};

} // namespace orb::assembler
