#include "testing/results.h"

#include <algorithm>

namespace orb::testing {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
  case Verdict::Passed: return "passed";
  case Verdict::Failed: return "failed";
  case Verdict::Error: return "error";
  }
  return {};
}

void omit(CaseResult& one) {
  one.misses = {};
  one.problem = {};
  one.again = {};
  one.footage = {};
  one.omitted = true;
}

void keep_first(GroupResult& group) {
  std::size_t told = 0;
  for (auto& one : group.cases)
    if (one.verdict != Verdict::Passed && ++told > most_told)
      omit(one);
}

Verdict GroupResult::verdict() const {
  auto worst = Verdict::Passed;
  for (const auto& one : cases)
    worst = std::max(worst, one.verdict);
  return worst;
}

Totals totals_of(const Results& results) {
  Totals totals;
  for (const auto& group : results.groups) {
    if (group.cases.empty()) // all of them run elsewhere
      continue;
    const bool passed = group.verdict() == Verdict::Passed;
    totals.cases += group.cases.size();
    totals.failed += static_cast<std::uint64_t>(
        std::count_if(group.cases.begin(), group.cases.end(),
                      [](const CaseResult& one) { return one.verdict != Verdict::Passed; }));
    ++totals.tests;
    totals.tests_passed += passed ? 1 : 0;
    totals.points += passed ? group.points : 0;
    totals.points_of += group.points;
  }
  return totals;
}

} // namespace orb::testing
