#pragma once

// Private to assembler/: what the operands of a command say, as numbers of the robot.

#include "assembler/names.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace orb::assembler {

/// A value as written for each operand of a command; null for one that is left out.
using Bound = std::array<const Value*, spec::macro_max_operands>;

/// Reads operands. What is wrong with them goes to `findings`.
class Operands {
public:
  Operands(const Program& program, const Names& names, Findings& findings)
      : program_(program), names_(names), findings_(findings) {}

  /// Which operand each value is for. Nothing, and a finding, where that does not work out.
  std::optional<Bound> bind(const Statement& statement, const spec::MacroCommandInfo& info);

  /// The value of an operand in the operand's own unit. Nothing, and a finding, where it has none.
  std::optional<std::int32_t> resolve(const Value& value, const spec::MacroOperand& operand,
                                      std::string_view command);

  /// `roll`, or `roll2` for a delay that does not fit into a byte.
  const spec::MacroCommandInfo* roll_for(const Value& delay) const;

  /// The bytes of a quoted text.
  std::string read_text(const Value& value);

private:
  void too_many(const Statement& statement, const spec::MacroCommandInfo& info, Span span);

  void unknown_operand(const spec::MacroCommandInfo& info, Span span);

  std::optional<std::int32_t> macro_id(Span span, const Name& name,
                                       const spec::MacroOperand& operand);

  /// The line that begins a macro of that name.
  std::string macro_line(Span name) const;

  std::optional<std::int32_t> unknown_name(Span span, const spec::MacroOperand& operand,
                                           std::string_view command);

  std::optional<std::int32_t> to_number(const Value& number, Span span,
                                        const spec::MacroOperand& operand,
                                        std::string_view command);

  void wrong_unit(const Value& number, Span span, const spec::MacroOperand& operand,
                  std::string_view command);

  /// `span` is where the number is used: it, or the name of a constant that holds it.
  void out_of_range(std::int64_t value, const Value& number, Span span,
                    const spec::MacroOperand& operand, std::string_view command);

  const Program& program_;
  const Names& names_;
  Findings& findings_;
};

} // namespace orb::assembler
