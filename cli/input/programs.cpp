#include "cli/input/programs.h"

#include "base/text.h"
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
  std::vector<std::string> programs; ///< by their endings, whatever they are
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
    else if (unknown && at->is_symlink(unknown))
      found.loops.push_back(path);
  }
  for (auto* names : {&found.programs, &found.folders, &found.loops})
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
      found_.programs.push_back(path);
      return std::nullopt;
    }
    const auto listing = list(path);
    if (listing.error) {
      add_trouble(path, cannot_read(path, listing.error));
      return std::nullopt;
    }
    if (const auto own = called_like_tests(listing); !own.empty()) {
      found_.programs.insert(found_.programs.end(), own.begin(), own.end());
      return std::nullopt;
    }
    const auto before = found_.programs.size();
    for (const auto& program : listing.programs)
      found_.programs.push_back(program);
    for (const auto& loop : listing.loops)
      add_trouble(loop, fmt::format("cannot read {}: the link leads nowhere", loop));
    for (const auto& folder : listing.folders)
      add_pupil(folder);
    if (found_.programs.size() == before)
      return Failure{ExitCode::Usage,
                     fmt::format("no program in {}: neither {} nor a folder with one",
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

  std::vector<std::string> called_like_tests(const Listing& listing) const {
    std::vector<std::string> own;
    for (const auto& stem : stems_)
      for (const auto ending : endings) {
        const auto name = stem + std::string(ending);
        const auto at = std::find_if(listing.programs.begin(), listing.programs.end(),
                                     [&](const std::string& path) {
                                       return disk::as_path(path).filename() == disk::as_path(name);
                                     });
        if (at == listing.programs.end())
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
    const auto own = called_like_tests(listing);
    if (!own.empty() || listing.programs.size() == 1) {
      const auto& programs = own.empty() ? listing.programs : own;
      found_.programs.insert(found_.programs.end(), programs.begin(), programs.end());
    } else if (listing.programs.empty()) {
      found_.missing.insert(folder);
      add_trouble(folder, fmt::format("{} holds no program; expected {}", folder, wanted()));
    } else {
      add_trouble(folder, fmt::format("{} holds {}; call the one to test {}", folder,
                                      plural(listing.programs.size(), "program"), wanted()));
    }
  }

  const std::set<std::string>& stems_;
  HandedIn found_;
};

} // namespace

tl::expected<HandedIn, Failure> read_programs(const std::vector<std::string>& paths,
                                              const std::set<std::string>& stems) {
  Reader reader(stems);
  for (const auto& path : paths)
    if (auto failure = reader.add(path))
      return tl::unexpected(*std::move(failure));
  return reader.take();
}

} // namespace orb::cli
