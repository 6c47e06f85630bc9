#pragma once

// Private to resolve.cpp.

#include "base/message.h"
#include "structured/meaning/symbols.h"
#include "structured/text/foreign.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::structured {

/// Reports names that stand for nothing, with what may have been meant. What a file that could not
/// be read may declare is not reported.
class UnknownNames {
public:
  /// Both outlive it.
  UnknownNames(Program& program, const Names& names);

  /// A name in an expression, or what is assigned to.
  void report(const Node& node, bool needs_declaration);
  /// What stands alone after `RGB`.
  void report_colour(Span span);
  /// The first word of a statement.
  void report_word(Span span);

private:
  Diagnostic& add(const Rule& rule, Span span, Message message, Message help = {});
  /// Says what a word of another language is here; false where it is none.
  bool report_foreign(Span span, Stands stands);
  void suggest(Span span, const std::vector<std::string_view>& candidates,
               const Row<Hole::Code>& unknown);

  Program& program_;
  const Names& names_;
  std::set<std::uint32_t> said_; ///< names that have been reported
  std::size_t unknown_ = 0;
  bool incomplete_; ///< a file that may declare what is unknown could not be read
  bool broken_;     ///< a line does not parse
};

} // namespace orb::structured
