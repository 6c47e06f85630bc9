#pragma once

#include "testing/results.h"

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

/// `17, 40 to 52`: seeds that failed, in few words.
std::string failed_seeds(const GroupResult& group);

/// The first case that did not pass; null where all did.
const CaseResult* first_failure(const GroupResult& group);

} // namespace orb::testing
