#pragma once

#include "assembler/assemble.h"
#include "assembler/parse.h"
#include "assembler/rules.h"
#include "base/suggest.h"
#include "base/text.h"
#include "base/utf8.h"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace orb::assembler {

using spec::MacroCommand;
using spec::MacroOperand;
using spec::MacroOperandKind;
using spec::MacroUnit;
using Origin = PlacedCommand::Origin;

struct Name {
  enum class Kind : std::uint8_t { Constant, Macro };
  Kind kind = Kind::Constant;
  Value value;           ///< of a constant
  std::size_t macro = 0; ///< of a macro
  Span span;
};

class Assembler {
public:
  Assembler(const Source& source, Folding folding);

  Assembly run();

private:
  std::string_view text(Span span) const { return source_.text().substr(span.begin, span.size()); }

  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {});

  AssembledMacro& macro() { return assembly_.macros[current_]; }

  const Value* values(const Statement& statement) const;

  // Names.

  void collect_names();

  void define(Span span, Name name);

  void define_constant(const Statement& statement);

  void define_macro(const Statement& statement);

  void read_attribute(AssembledMacro& defined, std::string_view attribute, const Value& value);

  std::optional<std::uint8_t> header_byte(const Value& value, int minimum, std::string_view what);

  void read_id(AssembledMacro& defined, const Value& value);

  /// The first id from `first` that no macro above has.
  void offer_id(Diagnostic& d, Span span, std::uint8_t first) const;

  void read_flag(AssembledMacro& defined, const Value& value);

  static void set_flags(AssembledMacro& defined, int flags);

  void check_id_is_free(const AssembledMacro& defined);

  const Name* find_name(std::string_view word) const;

  // Macros and their commands.

  void begin_unnamed();

  /// Room for what the rest of the file may hold.
  void reserve();

  void add(const Statement& statement);

  void end_macro();

  void add_raw(const Statement& statement);

  void add_command(const Statement& statement);

  void place(const spec::MacroCommandInfo& info, Span span, Span operand, Origin origin,
             const std::array<std::int32_t, spec::macro_max_operands>& value,
             std::string_view comment);

  /// Which operand each value is for. False, with a finding, where that does not work out.
  bool bind(const Statement& statement, const spec::MacroCommandInfo& info,
            std::array<const Value*, spec::macro_max_operands>& bound);

  bool unknown_operand(const spec::MacroCommandInfo& info, Span span);

  /// A delay that does not fit into a byte makes a roll a roll2.
  const spec::MacroCommandInfo* roll_for(const Value& delay);

  /// The number that a value stands for; null where it is none.
  const Value* constant(const Value& value) const;

  /// The value of an operand in the operand's own unit, or nothing and a finding.
  std::optional<std::int32_t> resolve(const Value& value, const MacroOperand& operand,
                                      std::string_view command);

  std::optional<std::int32_t> macro_id(Span span, const Name& name, const MacroOperand& operand);

  std::optional<std::int32_t> unknown_name(Span span, const MacroOperand& operand,
                                           std::string_view command);

  std::optional<std::int32_t> to_number(const Value& number, Span span, const MacroOperand& operand,
                                        std::string_view command);

  void wrong_unit(const Value& number, Span span, const MacroOperand& operand,
                  std::string_view command);

  /// The lines that wait as long; empty for what would be a page of them.
  static std::string waits_for(std::int64_t ms);

  /// `span` is where the number is used: it, or the name of a constant that holds it.
  void out_of_range(std::int64_t value, const Value& number, Span span, const MacroOperand& operand,
                    std::string_view command);

  std::string read_text(const Value& value);

  /// Takes a delay into the command before it. False where that has no delay of its own, or no
  /// room.
  bool fold(std::int32_t time_ms);

  const Source& source_;
  Folding folding_;
  Program program_;
  Assembly assembly_;
  std::unordered_map<std::string_view, Name> names_;
  std::size_t constants_ = 0;
  Span id_span_; ///< of the last id that was read
  std::size_t current_ = 0;
  bool inside_ = false;
  bool no_end_ = false;
  bool outside_reported_ = false;
  bool after_end_reported_ = false;
};

} // namespace orb::assembler
