#pragma once

#include "base/diagnostic.h"

#include <utility>
#include <vector>

namespace orb {

/// Collects the findings on a source, in the order in which they are added.
class Findings {
public:
  Findings() = default;
  /// Starts with `first`, such as the findings of the parser.
  explicit Findings(std::vector<Diagnostic> first) : all_(std::move(first)) {}

  /// Adds a finding. The reference is valid until the next call.
  Diagnostic& add(const Rule& rule, Span span, Message message, Message help = {}) {
    return all_.emplace_back(finding(rule, span, std::move(message), std::move(help)));
  }
  void add(Diagnostic diagnostic) { all_.push_back(std::move(diagnostic)); }

  std::vector<Diagnostic>& all() { return all_; }

private:
  std::vector<Diagnostic> all_;
};

} // namespace orb
