#pragma once

// Private to assembler/: what a file names, its constants and macros.

#include "assembler/assemble.h"
#include "assembler/text/program.h"
#include "base/findings.h"
#include "base/slots.h"

#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace orb::assembler {

/// What a name stands for.
struct Name {
  enum class Kind : std::uint8_t { Constant, Macro };
  Kind kind = Kind::Constant;
  Value value;           ///< of a constant
  std::size_t macro = 0; ///< of a macro, in Names::macros()
  Span span;
};

/// The names of a file, from its `.const` and `.macro` lines, wherever they stand.
class Names {
public:
  /// What is wrong with those lines goes to `findings`.
  Names(const Program& program, Findings& findings);

  /// Null where nothing has that name.
  const Name* find(std::string_view word) const;

  /// The number that a value stands for; null where it is none.
  const Value* number(const Value& value) const;

  /// All names and what they stand for, in no order.
  const std::unordered_map<std::string_view, Name>& all() const { return names_; }

  /// The macros in the order of the file, without commands yet.
  const std::vector<AssembledMacro>& macros() const { return macros_; }

private:
  void define(Span span, Name name);

  void define_constant(const Statement& statement);

  void define_macro(const Statement& statement);

  void read_attribute(AssembledMacro& defined, std::string_view attribute, const Value& value);

  std::optional<std::uint8_t> header_byte(const Value& value, const Slot& slot);

  void read_id(AssembledMacro& defined, const Value& value);

  /// The first id from `first` that no macro above has.
  void offer_id(Diagnostic& d, Span span, std::uint8_t first) const;

  void read_flag(AssembledMacro& defined, const Value& value);

  void check_id_is_free(const AssembledMacro& defined);

  const Program& program_;
  Findings& findings_;
  std::unordered_map<std::string_view, Name> names_;
  std::vector<AssembledMacro> macros_;
  Span id_span_; ///< of the last id that was read
};

} // namespace orb::assembler
