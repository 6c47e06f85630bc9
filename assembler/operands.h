#pragma once

// Private to assembler/: converts the operands of a command to numbers of the robot.

#include "assembler/constants.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace orb::assembler {

/// The written value of each operand of a command; null if it is omitted.
using Bound = std::array<const Value*, spec::macro_max_operands>;

/// Reads operands and reports errors to `findings`.
class Operands {
public:
  Operands(const Program& program, const Names& names, Findings& findings)
      : program_(program), names_(names), findings_(findings) {}

  /// Assigns values to operands; on failure returns nothing and reports a finding.
  std::optional<Bound> bind(const Statement& statement, const spec::MacroCommandInfo& info);

  /// The value of an operand in the operand's own unit; on failure returns nothing and reports a
  /// finding.
  std::optional<std::int32_t> resolve(const Value& value, const spec::MacroOperand& operand,
                                      std::string_view command);

  /// Returns `roll`, or `roll2` if the delay does not fit into a byte.
  const spec::MacroCommandInfo* roll_for(const Value& delay) const;

  /// The bytes of a quoted text.
  std::string read_text(const Value& value);

private:
  void too_many(const Statement& statement, const spec::MacroCommandInfo& info, Span span);

  void unknown_operand(const spec::MacroCommandInfo& info, Span span);

  std::optional<std::int32_t> macro_id(Span span, const Name& name,
                                       const spec::MacroOperand& operand);

  /// The `.macro` line for a macro of this name.
  std::string macro_line(Span name) const;

  std::optional<std::int32_t> unknown_name(Span span, const spec::MacroOperand& operand,
                                           std::string_view command);

  std::optional<std::int32_t> to_number(const Value& number, Span span,
                                        const spec::MacroOperand& operand,
                                        std::string_view command);

  void wrong_unit(const Value& number, Span span, const spec::MacroOperand& operand,
                  std::string_view command);

  /// `span` is where the number is used: the number itself, or the name of its constant.
  void out_of_range(std::int64_t value, const Value& number, Span span,
                    const spec::MacroOperand& operand, std::string_view command);

  const Program& program_;
  const Names& names_;
  Findings& findings_;
};

} // namespace orb::assembler
