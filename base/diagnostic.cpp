#include "base/diagnostic.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace orb {

std::string_view to_string(Severity severity) {
  switch (severity) {
  case Severity::Info: return "info";
  case Severity::Warning: return "warning";
  case Severity::Error: return "error";
  }
  return "error";
}

Diagnostic finding(const Rule& rule, Span span, Message message, Message help) {
  Diagnostic diagnostic;
  diagnostic.rule = &rule;
  diagnostic.severity = rule.severity;
  diagnostic.span = span;
  diagnostic.message = std::move(message);
  diagnostic.help = std::move(help);
  return diagnostic;
}

bool any_error(const std::vector<Diagnostic>& findings) {
  return std::any_of(findings.begin(), findings.end(), is_error);
}

Counts count(const std::vector<FileFindings>& files) {
  Counts counts;
  for (const auto& file : files)
    for (const auto& diagnostic : file.diagnostics)
      switch (diagnostic.severity) {
      case Severity::Info: ++counts.infos; break;
      case Severity::Warning: ++counts.warnings; break;
      case Severity::Error: ++counts.errors; break;
      }
  return counts;
}

void sort_by_place(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.span.begin, a.span.end, a.rule->id) <
           std::tuple(b.span.begin, b.span.end, b.rule->id);
  });
}

} // namespace orb
