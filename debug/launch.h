#pragma once

#include "base/exit_code.h"
#include "report/course.h"
#include "run/calibrate/profile.h"
#include "run/run.h"
#include "structured/text/files.h"
#include "testing/suite.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::debug {

/// What is to be debugged, as users name it.
struct Launch {
  std::vector<std::string> files;   ///< the program first, or a macro
  std::vector<std::string> stimuli; ///< files, or lines such as `at 2s shake`
  std::string course;               ///< a drawing; empty for none
  std::string test;                 ///< a test file in place of all these; empty for none
  std::string test_name;            ///< the test in it; the first where empty
  std::string language;             ///< as --lang has it
  std::optional<std::uint64_t> seed;
  std::vector<std::int32_t> numbers; ///< for `input`
  run::Client client = run::Client::Connected;
  std::optional<run::Profile> profile; ///< of the robot that the virtual ball drives like
  /// Of structured programs; where nothing is wanted, a test has those that it was judged with and
  /// everything else is steppable.
  std::optional<structured::Shape> shape;
};

/// The same, read: nothing of it changes while it runs.
struct Launched {
  std::vector<run::Input> own;
  std::unique_ptr<report::Course> course;
  std::unique_ptr<testing::Suite> suite;
  std::span<const run::Input> inputs; ///< of `own`, or of the suite
  run::Options options;
};

/// Reads it all through `files`. Fails with the errors of the first source that has some, a
/// line each.
tl::expected<std::unique_ptr<Launched>, Failure> read(const Launch& launch,
                                                      structured::Files& files);

/// That a robot can be the ball of that run: what only a simulation has is refused.
tl::expected<void, Failure> check_for_robot(const Launched& launched);

} // namespace orb::debug
