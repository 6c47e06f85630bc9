#pragma once

#include "structured/lift/letter_names.h"

#include <array>
#include <cstdint>
#include <string>

namespace orb::structured::lifting {

/// Writes the values of a numbered program as structured orbBasic, and records the variables they
/// use.
class LiftedValues {
public:
  LiftedValues(const compiler::Program& program, const LiftedNames& names)
      : program_(program), names_(names) {}

  std::string text(const compiler::Item& item) { return text_of(item.value); }
  /// The same without parentheses around the whole.
  std::string bare_text(std::uint32_t root) { return text_of(inner(root)); }
  /// Adds parentheses if the value has several parts.
  std::string operand(std::uint32_t root);
  /// The target of an assignment.
  std::string place(const compiler::Item& item);

  const std::string& letter_read(std::uint32_t which);
  const std::string& letter_set(std::uint32_t which);
  void use_elements() { uses_elements_ = true; }

  /// Declares the array, and the variables that are read but never set.
  std::string declarations() const;

private:
  std::string text_of(std::uint32_t root);
  std::string element();
  std::uint32_t inner(std::uint32_t root) const;

  const compiler::Program& program_;
  const LiftedNames& names_;
  std::array<bool, 25> read_{};
  std::array<bool, 25> set_{};
  bool uses_elements_ = false;
};

} // namespace orb::structured::lifting
