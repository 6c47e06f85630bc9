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

// Test files with what they name: programs read and compiled once, names looked up, and the list of
// cases that is to be run.

namespace orb::testing {

/// A program with all that goes along, ready to be run many times and by several threads.
struct Prepared {
  std::string name;     ///< as the user wrote it, or as it was found
  std::string language; ///< of plain text, whose name does not tell it (`--lang`); else empty
  std::vector<run::Input> inputs;
  std::string problem;          ///< why it cannot be run: its findings, or a sentence; else empty
  bool missing = false;         ///< it was not handed in
  std::size_t packed_bytes = 0; ///< of the image that is flashed
  std::size_t tested_bytes = 0; ///< of the one that runs: more where it keeps variables
  std::map<std::string, int> macros; ///< ids by name
};

/// A test file that has been read.
struct SuiteFile {
  std::unique_ptr<Source> source;
  TestFile file;                          ///< its findings hold those about names, too
  std::unique_ptr<report::Course> course; ///< null where it names none, or a bad one

  bool has_errors() const;
};

/// One test with one program: as many cases as it has seeds.
struct Group {
  std::size_t file = 0; ///< index into Suite::files
  std::size_t test = 0;
  std::size_t program = 0; ///< index into Suite::programs
  Seeds seeds;
  std::uint64_t first = 0;       ///< the number of its first case
  std::vector<Meaning> meanings; ///< one for each expectation
  std::vector<std::size_t> room; ///< the programs of the balls of a room; empty for one ball
};

/// A robot that was measured, and what the user calls it.
struct NamedProfile {
  std::string name;
  run::Profile profile;
};

/// What is to be run: cases are numbered over file, test, program and seed, in that order.
struct Suite {
  std::vector<SuiteFile> files;
  std::vector<Prepared> programs;
  std::vector<Group> groups;
  std::uint64_t cases = 0;
  std::optional<NamedProfile> ball; ///< which robot virtual balls drive like

  bool has_errors() const;
  const Test& test_of(const Group& group) const { return files[group.file].file.tests[group.test]; }
};

struct SuiteOptions {
  std::vector<std::string> programs; ///< in place of those that the files name; each file once
  std::map<std::string, std::string> troubles; ///< why some of these cannot be read: sentences
  std::set<std::string> missing;               ///< those of these that were not handed in
  std::optional<Seeds> seeds;                  ///< in place of theirs
  std::string only; ///< the one test to run, by its exact name; empty for all
  structured::Shape shape = structured::Shape::Shortest; ///< of structured programs
  std::optional<NamedProfile> ball;                      ///< which robot virtual balls drive like
  Say say = &in_english; ///< how it is said that a program cannot be run
};

/// A file as it was found: what findings call it, and its text.
struct GivenFile {
  std::string name;
  std::string text;
};

/// The robot that the tests of a file run on: its language is no newer than its firmware.
compiler::Target target_of(const TestFile& file);

/// Reads test files and what they name, through `files`. A file that does not name a program is
/// tested with the one beside it; one that cannot be read fails its tests. Fails where no test has
/// the name `only`.
tl::expected<Suite, Failure> make_suite(std::vector<GivenFile> given, const SuiteOptions& options,
                                        structured::Files& files);

/// How the name of a test file ends.
inline constexpr std::string_view file_ending = ".test";
/// Whether a file of that name is taken for a test file.
bool is_test(std::string_view file_name);

/// Whether a file is something else than a program or a macro: a course or tests.
bool is_no_program(std::string_view file_name);

/// Everything that is to be said about a test file.
std::vector<Diagnostic> check(const Source& source, structured::Files& files);
/// Adds that to what was found in files, for those of them that are tests.
void check_tests(std::span<const run::SourceFile> sources, std::vector<FileFindings>& found,
                 structured::Files& files);

} // namespace orb::testing
