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
  std::vector<std::string> programs;           ///< one per pupil: a file or a folder
  std::map<std::string, std::string> troubles; ///< why some of these cannot be read
  std::set<std::string> missing;               ///< folders without a program
  std::map<std::string, std::string> pupils;   ///< the pupil of each program
};

/// Reads what `--program` and `--class` name: files, files of addresses, and folders. In a folder,
/// takes the program named like one of `stems`; else programs, files of addresses, and subfolders
/// with one program each, or with a folder that contains it. A text file takes the place of a
/// missing program. Problems of one pupil among several are recorded as that pupil's trouble,
/// worded by `say`. Fails for wrong names and for folders without any program.
tl::expected<HandedIn, Failure> read_programs(const std::vector<std::string>& paths,
                                              const std::set<std::string>& stems, const Say& say);

/// The tests in the addresses that a class handed in. Fails if they differ, as pupils can change
/// their own, or if there are none.
tl::expected<std::vector<testing::GivenFile>, Failure> read_class_tests(const std::string& folder);

} // namespace orb::cli
