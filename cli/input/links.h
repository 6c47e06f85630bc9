#pragma once

#include "base/exit_code.h"

#include <map>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Programs shared by the playground: all files packed into an address (docs/using/teaching.md
// describes the form). A file of addresses reads as a folder: `anna.link/robot.orb` is a file in
// it.

namespace orb::cli {

/// The contents of one address.
struct Shared {
  std::string name = {}; ///< of the person who hands it in, usable in a path
  std::string main = {}; ///< the program; empty if nobody chose one
  std::map<std::string, std::string> files = {};
  std::string trouble = {}; ///< why it cannot be read; then there are no files
};

/// The extension of files of addresses.
inline constexpr std::string_view link_ending = ".link";
bool is_link_file(std::string_view path);

/// Reads the addresses in a text. An address without a name takes it from the words before it on
/// its line; names are made unique. Fails if there is none; the error is the end of a sentence.
tl::expected<std::vector<Shared>, std::string> read_links(std::string_view text);

/// The file at `path` read as a folder, with a subfolder per address if there are several.
struct LinkFolder {
  std::string path; ///< ends in `.link`, or in `.link/` and a name
  Shared shared;
};
tl::expected<std::vector<LinkFolder>, Failure> read_link_file(const std::string& path);

/// True if `path` leads through an existing file of addresses.
bool leads_through_link(const std::string& path);

/// Reads what such paths name; reads each file of addresses once.
class Links {
public:
  tl::expected<std::string, Failure> read(const std::string& path);

private:
  std::map<std::string, tl::expected<std::vector<LinkFolder>, Failure>> known_;
};

} // namespace orb::cli
