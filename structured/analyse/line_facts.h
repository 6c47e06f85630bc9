#pragma once

#include "structured/analyse/flow.h"

#include <cstdint>

namespace orb::structured {

/// The effects of a line on variables, elements and terms, including the routines it calls.
class LineFacts {
public:
  /// Both must outlive this and may change.
  LineFacts(const Code& code, const Flow& flow) : code_(code), flow_(flow) {}

  bool writes(const CodeLine& line, std::uint32_t variable) const;
  /// True if the line writes or reads the variable.
  bool touches(const CodeLine& line, std::uint32_t variable) const;
  bool sets_elements(const CodeLine& line) const;
  /// True if a term can be computed after the line instead of before it.
  bool passes(const CodeLine& line, std::uint32_t term) const;
  /// True if straight-line code ends at the line: the next line may be reached from elsewhere.
  static bool ends_text(const CodeLine& line);

  /// True if a term reads the variable.
  bool reads(std::uint32_t term, std::uint32_t variable) const;

private:
  /// True if a line changes something that a term reads.
  bool disturbs(const CodeLine& line, std::uint32_t term) const;
  std::uint8_t effects_of(const CodeLine& line) const;

  const Code& code_;
  const Flow& flow_;
};

} // namespace orb::structured
