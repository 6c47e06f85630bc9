#pragma once

#include "base/render.h"
#include "testing/results.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace orb::testing {

/// A class's programs against its tests: programs down, tests across.
struct Table {
  struct Row {
    std::string program;
    std::vector<const GroupResult*> cells; ///< of each test; null where it did not run here
    std::int64_t points = 0;
    std::int64_t points_of = 0;
  };
  std::vector<std::string> tests;
  std::vector<Row> rows;
};

/// The table of results in which a test ran with more than one program; else it has no rows.
Table table_of(const Results& results);
/// The table of any results.
Table whole_table(const Results& results);

/// Why programs cannot be run: told once for each, not with each test.
class ToldOnce {
public:
  /// Whether this failure of a group is still to be told.
  bool is_new(const GroupResult& group, const CaseResult& failure);

private:
  std::set<std::string> programs_;
};

/// `17, 40 to 52`: seeds that failed, in few words; cut where these are longer in English.
std::string failed_seeds(const GroupResult& group, const Say& say = &in_english,
                         std::size_t longest = std::string::npos);

/// The first case that did not pass; null where all did.
const CaseResult* first_failure(const GroupResult& group);

} // namespace orb::testing
