#include "testing/results.h"

#include <algorithm>
#include <fmt/format.h>

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

std::string story(const GroupResult& group, const CaseResult& one) {
  if (one.omitted)
    return fmt::format("details omitted: only the first {} failures of a test are kept\n",
                       most_told);
  if (one.verdict == Verdict::Error)
    return one.problem;
  std::string out;
  for (const auto& miss : one.misses) {
    out +=
        fmt::format("{}:{}: {}: {}", group.file, miss.line, miss.expected, in_english(miss.seen));
    out += miss.where.empty() ? "\n" : fmt::format(" ({})\n", miss.where);
  }
  return one.again.empty() ? out : out + fmt::format("rerun: {}\n", one.again);
}

Totals totals_of(const Results& results) {
  Totals totals;
  for (const auto& group : results.groups) {
    if (group.cases.empty()) // all of them ran on other machines
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
