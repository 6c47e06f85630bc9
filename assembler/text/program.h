#pragma once

#include "base/diagnostic.h"
#include "base/units.h"
#include "spec/macro.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace orb::assembler {

/// Numbers count in thousandths: 1.5 is 1500.
inline constexpr std::int64_t whole = 1000;
/// What longer numbers are taken for: beyond every operand, and far from where 64 bits end.
inline constexpr std::int64_t largest_number = 1'000'000'000;

/// An operand as it is written.
struct Value {
  enum class Kind : std::uint8_t { Number, Word, Text };
  Kind kind = Kind::Number;
  const Unit* unit = nullptr; ///< of a number; none: its operand's own
  bool is_known = true;       ///< a number whose unit and decimals are known
  Span span;
  Span name;                    ///< before the `=`; empty where the operand has none
  std::int64_t thousandths = 0; ///< of a number, at most `largest_number`
};

/// A line that says something.
struct Statement {
  enum class Kind : std::uint8_t { Command, Macro, Const, Raw, NoEnd };
  Kind kind = Kind::Command;
  const spec::MacroCommandInfo* info = nullptr; ///< of a command
  Span head;                                    ///< the mnemonic or directive
  Span span;                                    ///< with its operands
  std::uint32_t first = 0;                      ///< its values in Program::values
  std::uint32_t count = 0;
};

/// A file of macro source, in flat arrays. Lines that do not parse are left out of it and explained
/// in `diagnostics`, one finding a line.
struct Program {
  std::string_view text; ///< the source, which must outlive this
  std::vector<Statement> statements;
  std::vector<Value> values;
  std::vector<Diagnostic> diagnostics;

  /// What stands there.
  std::string_view text_of(Span span) const { return text.substr(span.begin, span.size()); }

  std::span<const Value> values_of(const Statement& statement) const {
    return std::span(values).subspan(statement.first, statement.count);
  }
};

} // namespace orb::assembler
