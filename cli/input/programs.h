#pragma once

#include "base/exit_code.h"
#include "base/render.h"
#include "testing/suite.h"

#include <map>
#include <set>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::cli {

/// The programs of a class.
struct HandedIn {
  std::vector<std::string> programs;           ///< what stands for each pupil: a file, or a folder
  std::map<std::string, std::string> troubles; ///< why some of these cannot be read
  std::set<std::string> missing;               ///< folders without a program
  std::map<std::string, std::string> pupils;   ///< whose each of the programs is
};

/// What `--program` and `--class` name: files, files of addresses, and folders. A folder holds the
/// program that is called like one of `stems`, else programs, files of addresses, and folders with
/// one program each, or with a folder that has it. A text stands for a program that is not there.
/// What is wrong with one of several is its own trouble, said by `say`; fails where a name is
/// wrong, and where a folder holds none at all.
tl::expected<HandedIn, Failure> read_programs(const std::vector<std::string>& paths,
                                              const std::set<std::string>& stems, const Say& say);

/// The tests that came with what a class hands in as addresses. Fails where they are not all the
/// same, as a pupil can change his own, and where there is none.
tl::expected<std::vector<testing::GivenFile>, Failure> read_class_tests(const std::string& folder);

} // namespace orb::cli
