#pragma once

#include "base/render.h"
#include "testing/results.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace orb::testing {

/// A class's programs and tests: one row per program, one column per test.
struct Table {
  struct Row {
    std::string program;
    std::vector<const GroupResult*> cells; ///< for each test; null if it did not run here
    std::int64_t points = 0;
    std::int64_t points_of = 0;
  };
  std::vector<std::string> tests;
  std::vector<Row> rows;
};

/// The table of results in which some test ran with several programs; otherwise it has no rows.
Table table_of(const Results& results);
/// The table of any results.
Table whole_table(const Results& results);

/// Reports why a program cannot be run once, not with each test.
class ToldOnce {
public:
  /// True if this failure of a group has not been reported yet.
  bool is_new(const GroupResult& group, const CaseResult& failure);

private:
  std::set<std::string> programs_;
};

/// Lists failed seeds briefly: `17, 40 to 52`; cut at `longest` characters of the English text.
std::string failed_seeds(const GroupResult& group, const Say& say = &in_english,
                         std::size_t longest = std::string::npos);

/// The first case that did not pass; null if all passed.
const CaseResult* first_failure(const GroupResult& group);

} // namespace orb::testing
