#pragma once

#include "base/message.h"
#include "base/time.h"
#include "report/journey.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Results as plain values. Every format is rendered from them, and the JSON form is read back to
// merge the shards of several machines.

namespace orb::testing {

enum class Verdict : std::uint8_t {
  Passed,
  Failed,
  Error, ///< the program could not be run
};

/// `passed`, `failed` or `error`, the same in all formats.
std::string_view to_string(Verdict verdict);

/// An expectation that was not met.
struct Miss {
  /// in the test file; for the implicit `never error`: the line of its test
  std::uint32_t line = 0;
  std::string expected; ///< as written: `expect near 60,0 by 12cm at end`
  Message seen;         ///< `nearest 18.2 cm from 60,0 at 3.1 s`
  std::string where; ///< what ran at that moment: `corner.bas:4: 40 goroll 90,100,1`; may be empty
};

/// What was recorded of a ball in a case.
struct SeenBall {
  std::string name; ///< in a room; empty for a single ball
  report::Journey journey;
};
/// All balls of a case, ordered by name. A deque keeps their addresses valid.
using Footage = std::deque<SeenBall>;

struct CaseResult {
  std::uint64_t seed = 1;
  Verdict verdict = Verdict::Passed;
  Duration lasted{}; ///< robot time
  std::uint64_t lines = 0;
  std::vector<Miss> misses;
  std::string problem; ///< for Verdict::Error
  std::string again;   ///< the command that shows a failure again; empty if none does
  /// What was recorded; null if a second run shows the same.
  std::shared_ptr<const Footage> footage;
  bool omitted = false; ///< it did not pass, and the three members above were dropped
};

/// One test with one program.
struct GroupResult {
  std::string file;
  std::string test;
  std::uint32_t line = 1; ///< of the test, in its file
  int points = 1;
  std::string program;
  std::uint64_t first = 0;       ///< number of its first case
  std::uint64_t count = 0;       ///< number of cases, on all machines
  std::vector<CaseResult> cases; ///< those that ran here, by seed

  /// The worst verdict of all cases.
  Verdict verdict() const;
};

/// Of the cases of a test that did not pass, this many keep their details; the others are counted.
inline constexpr std::size_t most_told = 100;
/// Drops the details of a failure.
void omit(CaseResult& one);
/// Calls omit() for all but the first `most_told` that did not pass.
void keep_first(GroupResult& group);

/// A share of the cases: every `count`-th, beginning with number `index`, from 1 to `count`.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;

  bool takes(std::uint64_t number) const { return number % count == index - 1; }
};

struct Results {
  std::uint64_t cases = 0;   ///< in all shards together
  std::vector<Shard> shards; ///< the shards present; empty if the run was not split
  std::vector<GroupResult> groups;
  std::vector<std::string> missing; ///< programs that were not handed in
};

struct Totals {
  std::uint64_t cases = 0;
  std::uint64_t failed = 0; ///< number of cases, including those in error
  std::uint64_t tests = 0;  ///< tests multiplied by programs
  std::uint64_t tests_passed = 0;
  std::int64_t points = 0;
  std::int64_t points_of = 0;
};
Totals totals_of(const Results& results);

/// The failures of a case in English, one line for each expectation.
std::string story(const GroupResult& group, const CaseResult& one);

} // namespace orb::testing
