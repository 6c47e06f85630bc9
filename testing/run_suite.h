#pragma once

#include "report/journey.h"
#include "testing/results.h"
#include "testing/suite.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

namespace orb::testing {

/// Runs a case on something other than the virtual ball. A failure says why it could not be run.
using Play = std::function<tl::expected<run::Ending, Failure>(
    const Suite& suite, const Group& group, const run::Options& options, run::Listener& listener,
    report::Journey& journey)>;

/// Judges a case.
using JudgeCase =
    std::function<CaseResult(const Suite& suite, const Group& group, std::uint64_t seed)>;

struct RunOptions {
  unsigned jobs = 1; ///< threads, including this one; 1 starts none
  Shard shard;
  JudgeCase judge; ///< called for one case at a time, in order; empty: on the virtual ball
};

/// Receives the progress of run_suite(), on the thread that called it.
class Progress {
public:
  virtual ~Progress() = default;
  virtual void on_cases(std::uint64_t done, std::uint64_t all) = 0;
};

/// Runs the cases of a suite that has no errors. Results do not depend on `jobs`.
Results run_suite(const Suite& suite, const RunOptions& options, Progress& progress);

/// The options, and so the world, that a test runs with.
run::Options options_of(const Suite& suite, const Group& group, std::uint64_t seed);

/// Runs one case on the virtual ball. If `footage` is not null, records everything and runs to the
/// end.
CaseResult run_case(const Suite& suite, const Group& group, std::uint64_t seed,
                    vm::NativePrograms* native, Footage* footage);

/// Runs one case through `play` and keeps what was seen: it cannot be run again.
CaseResult play_case(const Suite& suite, const Group& group, std::uint64_t seed, const Play& play);

/// A case whose program somebody else runs, such as JavaScript: hears the run, then judges it.
class Trial final {
public:
  /// `suite` and `group` must outlive it.
  Trial(const Suite& suite, const Group& group, std::uint64_t seed);
  ~Trial();

  /// The world of the run, and its bound.
  const run::Options& options() const;
  run::Listener& listener();
  /// The result, once the listener has heard the end.
  CaseResult judge(const run::Ending& ending) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace orb::testing
