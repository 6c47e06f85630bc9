#pragma once

#include "base/exit_code.h"
#include "base/render.h"
#include "run/calibrate/profile.h"
#include "run/input.h"
#include "testing/judge.h"
#include "testing/text/test_file.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Test files with everything they name: programs read and compiled once, names looked up, and the
// list of cases to run.

namespace orb::testing {

/// A compiled program with everything it needs. Several threads may run it many times.
struct Prepared {
  std::string name;     ///< as the user wrote it, or as found
  std::string language; ///< of a plain text file whose name does not tell (`--lang`); else empty
  std::vector<run::Input> inputs;
  std::string problem;               ///< why it cannot be run: findings or a sentence; else empty
  std::string elsewhere;             ///< of JavaScript: where it can be tested; else empty
  bool missing = false;              ///< it was not handed in
  std::size_t packed_bytes = 0;      ///< size of the image that is flashed
  std::size_t tested_bytes = 0;      ///< size of the image that runs: larger if it keeps variables
  std::map<std::string, int> macros; ///< macro ids by name

  bool is_javascript() const { return !elsewhere.empty(); }
  /// Why it cannot be run here; empty if it can.
  const std::string& obstacle() const { return problem.empty() ? elsewhere : problem; }
};

/// A test file that has been read.
struct SuiteFile {
  std::unique_ptr<Source> source;
  TestFile file;                          ///< its findings include those about names
  std::unique_ptr<report::Course> course; ///< null if the file names none, or a bad one

  bool has_errors() const;
};

/// One test with one program: one case for each seed.
struct Group {
  std::size_t file = 0; ///< index into Suite::files
  std::size_t test = 0;
  std::size_t program = 0; ///< index into Suite::programs
  Seeds seeds;
  std::uint64_t first = 0;       ///< number of its first case
  std::vector<Meaning> meanings; ///< one for each expectation
  std::vector<std::size_t> room; ///< programs of the balls of a room; empty for a single ball
};

/// A measured robot and the user's name for it.
struct NamedProfile {
  std::string name;
  run::Profile profile;
};

/// What to run. Cases are numbered by file, test, program and seed, in that order.
struct Suite {
  std::vector<SuiteFile> files;
  std::vector<Prepared> programs;
  std::vector<Group> groups;
  std::uint64_t cases = 0;
  std::optional<NamedProfile> ball; ///< the measured robot that virtual balls drive like

  bool has_errors() const;
  const Test& test_of(const Group& group) const { return files[group.file].file.tests[group.test]; }
};

struct SuiteOptions {
  std::vector<std::string> programs; ///< used in place of those that the files name; each file once
  /// sentences that say why some of them cannot be read
  std::map<std::string, std::string> troubles;
  std::set<std::string> missing; ///< those among them that were not handed in
  std::optional<Seeds> seeds;    ///< used in place of the tests' own
  std::string only;              ///< exact name of the one test to run; empty for all
  structured::Shape shape = structured::Shape::Shortest; ///< how structured programs are compiled
  std::optional<NamedProfile> ball; ///< the measured robot that virtual balls drive like
  Say say = &in_english;            ///< words the reason why a program cannot be run
};

/// A file with the name that findings use and its text.
struct GivenFile {
  std::string name;
  std::string text;
};

/// The robot that a file's tests run on. Its firmware limits the language.
compiler::Target target_of(const TestFile& file);

/// Reads test files and what they name, through `files`. A test file that names no program tests
/// the one beside it. The tests of an unreadable program fail. Fails if no test has the name
/// `only`.
tl::expected<Suite, Failure> make_suite(std::vector<GivenFile> given, const SuiteOptions& options,
                                        structured::Files& files);

/// The extension of test files.
inline constexpr std::string_view file_ending = ".test";
/// True if a file of this name is a test file.
bool is_test(std::string_view file_name);

/// True if a file of this name is a program of Sphero Edu, which orb itself cannot run.
bool is_javascript(std::string_view file_name);

/// True if a file is neither a program nor a macro: a course or tests.
bool is_no_program(std::string_view file_name);

/// Returns all findings about a test file.
std::vector<Diagnostic> check(const Source& source, structured::Files& files);
/// Adds the findings of check() for those sources that are test files.
void check_tests(std::span<const run::SourceFile> sources, std::vector<FileFindings>& found,
                 structured::Files& files);

} // namespace orb::testing
