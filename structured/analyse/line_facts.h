#pragma once

#include "structured/analyse/flow.h"

#include <cstdint>

namespace orb::structured {

/// What a line does to variables, elements and the values of terms, the routines that it calls
/// included.
class LineFacts {
public:
  /// Both outlive it and may change.
  LineFacts(const Code& code, const Flow& flow) : code_(code), flow_(flow) {}

  bool writes(const CodeLine& line, std::uint32_t variable) const;
  /// Writes or reads.
  bool touches(const CodeLine& line, std::uint32_t variable) const;
  bool sets_elements(const CodeLine& line) const;
  /// Whether a term can be computed after a line instead of before it.
  bool passes(const CodeLine& line, std::uint32_t term) const;
  /// Whether straight text ends at a line: what follows may come from elsewhere.
  static bool ends_text(const CodeLine& line);

  /// Whether a term reads a variable.
  bool reads(std::uint32_t term, std::uint32_t variable) const;

private:
  /// Whether a line changes what a term reads.
  bool disturbs(const CodeLine& line, std::uint32_t term) const;
  std::uint8_t effects_of(const CodeLine& line) const;

  const Code& code_;
  const Flow& flow_;
};

} // namespace orb::structured
