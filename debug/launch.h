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

/// What to debug, as users specify it.
struct Launch {
  std::vector<std::string> files;   ///< programs first, or a macro
  std::vector<std::string> stimuli; ///< files, or lines such as `at 2s shake`
  std::string course;               ///< path of a drawing; empty for none
  std::string test;      ///< path of a test file used in place of the above; empty for none
  std::string test_name; ///< name of the test; empty for the first
  std::string language;  ///< as in --lang
  std::optional<std::uint64_t> seed;
  std::vector<std::int32_t> numbers; ///< answers to `input`
  run::Client client = run::Client::Connected;
  std::optional<run::Profile> profile; ///< the measured robot that the virtual ball drives like
  /// For structured programs. By default a test keeps the shape that it is judged with, and
  /// everything else is compiled for stepping.
  std::optional<structured::Shape> shape;
};

/// The loaded form of a Launch; it stays unchanged during the run.
struct Launched {
  std::vector<run::Input> own;
  std::unique_ptr<report::Course> course;
  std::unique_ptr<testing::Suite> suite;
  std::span<const run::Input> inputs; ///< refers to `own`, or to the suite
  run::Options options;
};

/// Reads everything through `files`. Fails with the errors of the first source that has any, one
/// per line.
tl::expected<std::unique_ptr<Launched>, Failure> read(const Launch& launch,
                                                      structured::Files& files);

/// Fails if the run uses features that only the simulation has.
tl::expected<void, Failure> check_for_robot(const Launched& launched);

} // namespace orb::debug
