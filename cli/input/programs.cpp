#include "cli/input/programs.h"

#include "base/text/text.h"
#include "cli/input/links.h"
#include "disk/disk.h"
#include "run/input.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> endings{".orb", ".bas", ".macro"};

bool is_program(std::string_view name) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

/// What a folder holds, in the order of names, without what is hidden.
struct Listing {
  std::vector<std::string> programs;  ///< by their endings, whatever they are
  std::vector<std::string> addresses; ///< files of them
  std::vector<std::string> folders;
  std::vector<std::string> loops; ///< links that lead nowhere
  std::error_code error;
};

Listing list(const std::string& folder) {
  Listing found;
  for (fs::directory_iterator at(disk::as_path(folder), found.error);
       !found.error && at != fs::directory_iterator(); at.increment(found.error)) {
    const auto name = at->path().filename().string();
    const auto path = (disk::as_path(folder) / disk::as_path(name)).generic_string();
    std::error_code unknown;
    if (name.starts_with('.'))
      continue;
    if (at->is_directory(unknown))
      found.folders.push_back(path);
    else if (is_program(name))
      found.programs.push_back(path);
    else if (is_link_file(name))
      found.addresses.push_back(path);
    else if (unknown && at->is_symlink(unknown))
      found.loops.push_back(path);
  }
  for (auto* names : {&found.programs, &found.addresses, &found.folders, &found.loops})
    std::sort(names->begin(), names->end());
  return found;
}

class Reader {
public:
  explicit Reader(const std::set<std::string>& stems) : stems_(stems) {}

  /// What was named on the command line; why it cannot be.
  std::optional<Failure> add(const std::string& path) {
    std::error_code error;
    const auto link = fs::symlink_status(disk::as_path(path), error);
    if (link.type() == fs::file_type::not_found)
      return Failure{ExitCode::File,
                     fmt::format("cannot read {}; check the name and the folder", path)};
    if (!fs::is_directory(disk::as_path(path), error)) {
      if (is_link_file(path))
        add_addresses(path);
      else
        found_.programs.push_back(path);
      return std::nullopt;
    }
    const auto listing = list(path);
    if (listing.error) {
      add_trouble(path, cannot_read(path, listing.error));
      return std::nullopt;
    }
    const auto own = called_like_tests(listing.programs);
    if (listing.addresses.empty() && !own.empty()) {
      found_.programs.insert(found_.programs.end(), own.begin(), own.end());
      return std::nullopt;
    }
    const auto before = found_.programs.size();
    for (const auto& program : listing.programs)
      found_.programs.push_back(program);
    for (const auto& file : listing.addresses)
      add_addresses(file);
    for (const auto& loop : listing.loops)
      add_trouble(loop, fmt::format("cannot read {}: broken symbolic link", loop));
    for (const auto& folder : listing.folders)
      add_pupil(folder);
    if (found_.programs.size() == before)
      return Failure{ExitCode::Usage, fmt::format("no program in {}: it has no {}, no .link file "
                                                  "with an address, and no folder with either",
                                                  path, wanted())};
    std::sort(found_.programs.begin() + static_cast<std::ptrdiff_t>(before), found_.programs.end());
    return std::nullopt;
  }

  HandedIn take() { return std::move(found_); }

private:
  static std::string cannot_read(const std::string& path, const std::error_code& error) {
    return fmt::format("cannot read {}: {}", path, error.message());
  }

  /// The names of programs that tests ask for.
  std::string wanted() const {
    std::vector<std::string> names;
    for (const auto& stem : stems_)
      names.push_back(stem + std::string(endings.front()));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  std::vector<std::string> called_like_tests(const std::vector<std::string>& programs) const {
    std::vector<std::string> own;
    for (const auto& stem : stems_)
      for (const auto ending : endings) {
        const auto name = stem + std::string(ending);
        const auto at = std::find_if(programs.begin(), programs.end(), [&](const auto& path) {
          return disk::as_path(path).filename() == disk::as_path(name);
        });
        if (at == programs.end())
          continue;
        own.push_back(*at);
        break;
      }
    return own;
  }

  void add_trouble(const std::string& path, std::string sentence) {
    found_.programs.push_back(path);
    found_.troubles.emplace(path, std::move(sentence));
  }

  /// A folder among others: one pupil's.
  void add_pupil(const std::string& folder) {
    const auto listing = list(folder);
    if (listing.error)
      return add_trouble(folder, cannot_read(folder, listing.error));
    if (listing.programs.empty() && !listing.addresses.empty()) {
      for (const auto& file : listing.addresses)
        add_addresses(file);
      return;
    }
    add_handed_in(folder, listing.programs);
  }

  /// One pupil's programs: the one that is meant, if it is clear.
  void add_handed_in(const std::string& folder, const std::vector<std::string>& programs) {
    const auto own = called_like_tests(programs);
    if (!own.empty() || programs.size() == 1) {
      const auto& chosen = own.empty() ? programs : own;
      found_.programs.insert(found_.programs.end(), chosen.begin(), chosen.end());
    } else if (programs.empty()) {
      found_.missing.insert(folder);
      add_trouble(folder, fmt::format("{} holds no program; expected {}", folder, wanted()));
    } else {
      add_trouble(folder, fmt::format("{} holds {}; call the one to test {}", folder,
                                      plural(programs.size(), "program"), wanted()));
    }
  }

  /// What the playground shares: each address is one pupil's.
  void add_addresses(const std::string& file) {
    const auto folders = read_link_file(file);
    if (!folders)
      return add_trouble(file, folders.error().message);
    for (const auto& [folder, shared] : *folders) {
      if (!shared.trouble.empty()) {
        add_trouble(folder, shared.trouble);
        continue;
      }
      std::vector<std::string> programs;
      for (const auto& [name, text] : shared.files)
        if (is_program(name))
          programs.push_back(folder + "/" + name);
      const bool has_main = shared.files.contains(shared.main) && is_program(shared.main);
      if (has_main && called_like_tests(programs).empty())
        programs = {folder + "/" + shared.main};
      add_handed_in(folder, programs);
    }
  }

  const std::set<std::string>& stems_;
  HandedIn found_;
};

/// The files of addresses in a folder and in those of its pupils.
std::vector<std::string> addresses_of(const std::string& folder) {
  const auto listing = list(folder);
  auto files = listing.addresses;
  for (const auto& pupil : listing.folders) {
    const auto more = list(pupil).addresses;
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

} // namespace

tl::expected<HandedIn, Failure> read_programs(const std::vector<std::string>& paths,
                                              const std::set<std::string>& stems) {
  Reader reader(stems);
  for (const auto& path : paths)
    if (auto failure = reader.add(path))
      return tl::unexpected(*std::move(failure));
  return reader.take();
}

tl::expected<std::vector<testing::GivenFile>, Failure> read_class_tests(const std::string& folder) {
  const auto refuse = [&](const std::string& what) {
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("{}; name the lesson's test file: `orb test robot.test --class {}`",
                            what, folder)});
  };
  std::optional<LinkFolder> first;
  std::map<std::string, std::string> tests;
  for (const auto& file : addresses_of(folder)) {
    const auto addresses = read_link_file(file);
    if (!addresses)
      continue; // a trouble of that pupil
    for (const auto& address : *addresses) {
      if (!address.shared.trouble.empty())
        continue;
      auto own = address.shared.files;
      std::erase_if(own, [](const auto& one) { return !testing::is_test(one.first); });
      if (!first) {
        first = address;
        tests = std::move(own);
      } else if (own != tests) {
        return refuse(
            fmt::format("the tests in {} differ from those in {}", address.path, first->path));
      }
    }
  }
  if (tests.empty())
    return refuse(fmt::format("there are no tests in {}", folder));
  std::vector<testing::GivenFile> given;
  for (auto& [name, text] : tests)
    given.push_back({first->path + "/" + name, std::move(text)});
  return given;
}

} // namespace orb::cli
