#pragma once

#include "base/exit_code.h"

#include <map>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// What the playground shares: a program with all its files in an address (docs/teaching.md has the
// form). A file of such addresses reads as a folder: `anna.link/robot.orb` is a file in it.

namespace orb::cli {

/// What one address holds.
struct Shared {
  std::string name = {}; ///< of whoever hands it in, made fit for a path
  std::string main = {}; ///< the program; empty where nobody chose one
  std::map<std::string, std::string> files = {};
  std::string trouble = {}; ///< why it cannot be read; there are no files then
};

/// How a file of addresses ends.
inline constexpr std::string_view link_ending = ".link";
bool is_link_file(std::string_view path);

/// The addresses of a text, in any number of its lines. One without a name is called by the words
/// before it in its line; no two are called the same. Fails where there is none: a sentence's end.
tl::expected<std::vector<Shared>, std::string> read_links(std::string_view text);

/// The file at `path`, read as a folder: a folder of its own for each address where there are
/// several.
struct LinkFolder {
  std::string path; ///< with `.link` at its end, or `.link/` and a name
  Shared shared;
};
tl::expected<std::vector<LinkFolder>, Failure> read_link_file(const std::string& path);

/// Whether `path` leads through a file of addresses that is there.
bool leads_through_link(const std::string& path);

/// Reads what such paths name, each file of addresses once.
class Links {
public:
  tl::expected<std::string, Failure> read(const std::string& path);

private:
  std::map<std::string, tl::expected<std::vector<LinkFolder>, Failure>> known_;
};

} // namespace orb::cli
