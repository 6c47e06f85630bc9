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

// What came out, as values that know nothing of balls: every format is printed from these, and the
// JSON form is read back to join the parts of several machines.

namespace orb::testing {

enum class Verdict : std::uint8_t {
  Passed,
  Failed,
  Error, ///< the program could not be run
};

/// `passed`, `failed` or `error`: the words of all formats.
std::string_view to_string(Verdict verdict);

/// An expectation that was not met.
struct Miss {
  std::uint32_t line = 0; ///< of the test file; of the silent `never error`: of its test
  std::string expected;   ///< as it is written: `expect near 60,0 by 12cm at end`
  Message seen;           ///< `nearest 18.2 cm from 60,0 at 3.1 s`
  std::string where;      ///< what ran then: `corner.bas:4: 40 goroll 90,100,1`; may be empty
};

/// What was seen of a ball in a case.
struct SeenBall {
  std::string name; ///< in a room; empty for a ball alone
  report::Journey journey;
};
/// All balls of a case, in the order of their names. A deque keeps them where they are.
using Footage = std::deque<SeenBall>;

struct CaseResult {
  std::uint64_t seed = 1;
  Verdict verdict = Verdict::Passed;
  Duration lasted{}; ///< robot time
  std::uint64_t lines = 0;
  std::vector<Miss> misses;
  std::string problem; ///< with Verdict::Error
  std::string again;   ///< the command that shows a failure; empty where none does
  /// What was seen of it; null where running it once more shows the same.
  std::shared_ptr<const Footage> footage;
  bool omitted = false; ///< it did not pass, and these three are not kept
};

/// One test with one program.
struct GroupResult {
  std::string file;
  std::string test;
  std::uint32_t line = 1; ///< of the test in its file
  int points = 1;
  std::string program;
  std::uint64_t first = 0;       ///< the number of its first case
  std::uint64_t count = 0;       ///< how many cases it has, here or elsewhere
  std::vector<CaseResult> cases; ///< those that ran here, by their seeds

  /// The worst of all cases.
  Verdict verdict() const;
};

/// Of the cases of a test that did not pass the first so many are kept whole; the others are
/// counted.
inline constexpr std::size_t most_told = 100;
/// Forgets what a case failed at.
void omit(CaseResult& one);
/// omit() of all but the first `most_told` that did not pass.
void keep_first(GroupResult& group);

/// A share of the cases: every `count`-th, beginning with number `index` of 1 to `count`.
struct Shard {
  std::uint64_t index = 1;
  std::uint64_t count = 1;

  bool takes(std::uint64_t number) const { return number % count == index - 1; }
};

struct Results {
  std::uint64_t cases = 0;   ///< of the whole, wherever they ran
  std::vector<Shard> shards; ///< what is here; empty for all
  std::vector<GroupResult> groups;
  std::vector<std::string> missing; ///< programs that were not handed in
};

struct Totals {
  std::uint64_t cases = 0;
  std::uint64_t failed = 0; ///< cases, with those in error
  std::uint64_t tests = 0;  ///< tests times programs
  std::uint64_t tests_passed = 0;
  std::int64_t points = 0;
  std::int64_t points_of = 0;
};
Totals totals_of(const Results& results);

} // namespace orb::testing
