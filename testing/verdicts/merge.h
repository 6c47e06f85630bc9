#pragma once

#include "base/exit_code.h"
#include "testing/results.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::testing {

/// Results as a file holds them.
struct Part {
  std::string name;
  Results results;
};

/// Reads what render_json() wrote. Fails with code 3 where `text` is something else.
tl::expected<Part, Failure> read_results(std::string name, std::string_view text);

/// Joins the shards of one command, in any order. Fails with code 2 where they are not parts of the
/// same, where runs are there twice, or where some are missing. The whole is what one machine would
/// have had.
tl::expected<Results, Failure> merge(std::vector<Part> parts);

} // namespace orb::testing
