#pragma once

// Private to resolve.cpp.

#include "base/message.h"
#include "structured/meaning/symbols.h"
#include "structured/text/foreign_words.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// Reports undefined names with suggestions. Skips names that a file which could not be read may
/// declare.
class UnknownNames {
public:
  /// Both must outlive this.
  UnknownNames(Program& program, const Names& names);

  /// Reports a name in an expression, or an assigned one.
  void report(const Node& node, bool needs_declaration);
  /// Reports a single word after `RGB`.
  void report_colour(Span span);
  /// Reports the first word of a statement.
  void report_word(Span span);

private:
  Diagnostic& add(const Rule& rule, Span span, Message message, Message help = {});
  /// Explains a word of another language; returns false if it is not one.
  bool report_foreign(Span span, Stands stands);
  void suggest(Span span, const std::vector<std::string_view>& candidates,
               const Row<Hole::Code>& unknown);

  Program& program_;
  const Names& names_;
  std::set<std::uint32_t> said_; ///< names already reported
  std::size_t unknown_ = 0;
  bool incomplete_; ///< a file that may declare unknown names could not be read
  bool broken_;     ///< a line does not parse
};

} // namespace orb::structured
