#pragma once

#include "report/journey.h"
#include "testing/results.h"
#include "testing/suite.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace orb::testing {

/// Runs a case elsewhere than on the virtual ball. A failure is why it could not be run.
using Play = std::function<tl::expected<run::Ending, Failure>(
    const Suite& suite, const Group& group, const run::Options& options, run::Listener& listener,
    report::Journey& journey)>;

struct RunOptions {
  unsigned jobs = 1; ///< threads, this one included; 1 starts none
  Shard shard;
  Play play; ///< one case at a time, in order; empty: the virtual ball
};

/// Hears how a run of a suite goes on, on the thread that called run_suite().
class Progress {
public:
  virtual ~Progress() = default;
  virtual void on_cases(std::uint64_t done, std::uint64_t all) = 0;
};

/// Runs the cases of a suite without errors. What comes out does not depend on `jobs`.
Results run_suite(const Suite& suite, const RunOptions& options, Progress& progress);

/// The world of a test: what it runs with.
run::Options options_of(const Suite& suite, const Group& group, std::uint64_t seed);

/// Runs one case on the virtual ball. Where `footage` is not null, all that is seen is gathered,
/// and the run goes on to its end.
CaseResult run_case(const Suite& suite, const Group& group, std::uint64_t seed,
                    vm::NativePrograms* native, Footage* footage);

/// Runs one case elsewhere, and keeps what was seen of it: it cannot be seen again.
CaseResult play_case(const Suite& suite, const Group& group, std::uint64_t seed, const Play& play);

} // namespace orb::testing
