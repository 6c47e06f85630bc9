#pragma once

// Private to assembler/: the names of a file: its constants and macros.

#include "assembler/assemble.h"
#include "assembler/text/program.h"
#include "base/findings.h"
#include "base/slots.h"

#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace orb::assembler {

/// The meaning of a name.
struct Name {
  enum class Kind : std::uint8_t { Constant, Macro };
  Kind kind = Kind::Constant;
  Value value;           ///< for a constant
  std::size_t macro = 0; ///< for a macro: its index in Names::macros()
  Span span;
};

/// Reports a number that is none, such as `500sm`.
void add_no_number(Findings& findings, const Program& program, Span span);

/// The names of a file, from its `.const` and `.macro` lines; order does not matter.
class Names {
public:
  /// Reports errors in those lines to `findings`.
  Names(const Program& program, Findings& findings);

  /// Finds a name; null if it is undefined.
  const Name* find(std::string_view word) const;

  /// Resolves a value to a number; null if it is not one.
  const Value* number(const Value& value) const;

  /// All names with their meanings, unordered.
  const std::unordered_map<std::string_view, Name>& all() const { return names_; }

  /// The macros in file order, still without commands.
  const std::vector<AssembledMacro>& macros() const { return macros_; }

private:
  void define(Span span, Name name);

  void define_constant(const Statement& statement);

  void define_macro(const Statement& statement);

  void read_attribute(AssembledMacro& defined, std::string_view attribute, const Value& value);

  std::optional<std::uint8_t> header_byte(const Value& value, const Slot& slot);

  void read_id(AssembledMacro& defined, const Value& value);

  /// Offers the first id from `first` that no macro above uses.
  void offer_id(Diagnostic& d, Span span, std::uint8_t first) const;

  void read_flag(AssembledMacro& defined, const Value& value);

  void check_id_is_free(const AssembledMacro& defined);

  const Program& program_;
  Findings& findings_;
  std::unordered_map<std::string_view, Name> names_;
  std::vector<AssembledMacro> macros_;
  Span id_span_; ///< of the last id read
};

} // namespace orb::assembler
