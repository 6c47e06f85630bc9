#pragma once

#include "base/exit_code.h"
#include "testing/results.h"

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::testing {

/// The results in one file.
struct Part {
  std::string name;
  Results results;
};

/// Reads what render_json() wrote. Fails with code 3 for other texts.
tl::expected<Part, Failure> read_results(std::string name, std::string_view text);

/// Merges the shards of one command, in any order. Fails with code 2 if they belong to different
/// commands, or if runs are duplicated or missing. The result equals that of a single machine.
tl::expected<Results, Failure> merge(std::vector<Part> parts);

} // namespace orb::testing
