#pragma once

// Private to assembler/: what is found while a file is assembled.

#include "base/diagnostic.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orb::assembler {

/// The findings on one source, in the order in which they are made. They quote it.
class Findings {
public:
  Findings(std::string_view source, std::vector<Diagnostic> first)
      : source_(source), list_(std::move(first)) {}

  /// What stands there.
  std::string_view text(Span span) const { return source_.substr(span.begin, span.size()); }

  /// Adds a finding. The reference holds until the next one.
  Diagnostic& report(const Rule& rule, Span span, std::string message, std::string help = {}) {
    list_.push_back(finding(rule, span, std::move(message), std::move(help)));
    return list_.back();
  }

  Diagnostic& last() { return list_.back(); }
  bool empty() const { return list_.empty(); }

  /// All of them, by place.
  std::vector<Diagnostic> sorted() && {
    sort_by_place(list_);
    return std::move(list_);
  }

private:
  std::string_view source_;
  std::vector<Diagnostic> list_;
};

} // namespace orb::assembler
