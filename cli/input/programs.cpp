#include "cli/input/programs.h"

#include "base/text/text.h"
#include "cli/input/inputs.h"
#include "cli/input/links.h"
#include "disk/disk.h"
#include "run/input.h"
#include "testing/texts.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <span>
#include <unordered_map>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> endings{".orb", ".bas", ".macro"};

/// Archives as mail programs and learning platforms make them; the pupil or teacher has to unpack
/// them.
constexpr std::array<std::string_view, 4> packed_endings{".zip", ".rar", ".7z", ".tar.gz"};
constexpr std::string_view text_ending = ".txt";
// Enough names to show what was handed in.
constexpr std::size_t most_named = 3;

bool has_one_of(std::string_view name, std::span<const std::string_view> all) {
  return std::any_of(all.begin(), all.end(),
                     [&](std::string_view ending) { return has_ending(name, ending); });
}
bool is_program(std::string_view name) {
  return has_one_of(name, endings);
}

/// The contents of a folder by name, without hidden files.
struct Listing {
  std::vector<std::string> programs = {};  ///< known by their extensions
  std::vector<std::string> texts = {};     ///< plain text files that may be programs
  std::vector<std::string> addresses = {}; ///< files of addresses
  std::vector<std::string> folders = {};
  std::vector<std::string> loops = {};  ///< broken links
  std::vector<std::string> packed = {}; ///< archives
  std::vector<std::string> others = {};
  std::error_code error = {};

  void take(const Listing& more) {
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(programs, more.programs);
    append(texts, more.texts);
    append(addresses, more.addresses);
    append(packed, more.packed);
    append(others, more.others);
  }
};

Listing list(const std::string& folder) {
  Listing found;
  for (fs::directory_iterator at(disk::as_path(folder), found.error);
       !found.error && at != fs::directory_iterator(); at.increment(found.error)) {
    const auto name = at->path().filename().string();
    const auto path = (disk::as_path(folder) / disk::as_path(name)).generic_string();
    std::error_code unknown;
    if (name.starts_with('.') || name == "__MACOSX") // macOS adds it to archives
      continue;
    if (at->is_directory(unknown))
      found.folders.push_back(path);
    else if (is_program(name))
      found.programs.push_back(path);
    else if (is_link_file(name))
      found.addresses.push_back(path);
    else if (unknown && at->is_symlink(unknown))
      found.loops.push_back(path);
    else if (has_ending(name, text_ending))
      found.texts.push_back(path);
    else if (has_one_of(name, packed_endings))
      found.packed.push_back(path);
    else
      found.others.push_back(path);
  }
  for (auto* names : {&found.programs, &found.texts, &found.addresses, &found.folders, &found.loops,
                      &found.packed, &found.others})
    std::sort(names->begin(), names->end());
  return found;
}

std::string name_of(const std::string& path) {
  return disk::as_path(path).filename().string();
}

class ProgramReader {
public:
  ProgramReader(const std::set<std::string>& stems, const Say& say) : stems_(stems), say_(say) {}

  /// Adds what a word of the command line names; returns why it cannot.
  std::optional<Failure> add(const std::string& path) {
    std::error_code error;
    const auto link = fs::symlink_status(disk::as_path(path), error);
    if (link.type() == fs::file_type::not_found)
      return Failure{ExitCode::File,
                     fmt::format("cannot read {}; check the name and the folder", path)};
    if (!fs::is_directory(disk::as_path(path), error)) {
      if (is_link_file(path))
        add_addresses(path, {});
      else
        add_program(path, std::string(stem(path)));
      return std::nullopt;
    }
    const auto listing = list(path);
    if (listing.error) {
      add_trouble(path, name_of(path), cannot_read(path, listing.error));
      return std::nullopt;
    }
    const auto own = called_like_tests(listing.programs);
    if (listing.addresses.empty() && !own.empty()) {
      for (const auto& program : own)
        add_program(program, name_of(path));
      return std::nullopt;
    }
    const auto before = found_.programs.size();
    add_class(listing);
    if (found_.programs.size() == before)
      return Failure{ExitCode::Usage, fmt::format("no program in {}: it has no {}, no .link file "
                                                  "with an address, and no folder with either",
                                                  path, wanted())};
    std::sort(found_.programs.begin() + static_cast<std::ptrdiff_t>(before), found_.programs.end());
    return std::nullopt;
  }

  HandedIn take() { return std::move(found_); }

private:
  std::string cannot_read(const std::string& path, const std::error_code& error) const {
    return say_(testing::texts::CannotReadBecause(path, Message::as_is(error.message())));
  }

  /// The program names that tests ask for.
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
        const auto at = std::find_if(programs.begin(), programs.end(), [&](const auto& path) {
          return equal_words(name_of(path), stem + std::string(ending));
        });
        if (at == programs.end())
          continue;
        own.push_back(*at);
        break;
      }
    return own;
  }

  void add_program(const std::string& path, const std::string& pupil) {
    found_.programs.push_back(path);
    found_.pupils.emplace(path, pupil);
  }

  void add_trouble(const std::string& path, const std::string& pupil, std::string sentence) {
    add_program(path, pupil);
    found_.troubles.emplace(path, std::move(sentence));
  }

  /// A folder of many pupils' work.
  void add_class(const Listing& listing) {
    for (const auto& program : listing.programs)
      add_program(program, std::string(stem(program)));
    for (const auto& text : listing.texts)
      add_loose_text(text);
    for (const auto& file : listing.addresses)
      add_addresses(file, {});
    for (const auto& loop : listing.loops)
      add_trouble(loop, name_of(loop), say_(testing::texts::BrokenLink(loop)));
    for (const auto& file : listing.packed)
      add_trouble(file, std::string(stem(file)), say_(testing::texts::Packed(file)));
    for (const auto& folder : listing.folders)
      add_pupil(folder);
  }

  /// A text file among programs and folders: a program, or notes nobody wants to test.
  void add_loose_text(const std::string& path) {
    auto text = read_text(path);
    if (!text)
      return;
    const auto pupil = std::string(stem(path));
    if (const auto links = read_links(*text); links)
      return add_trouble(
          path, pupil,
          say_(testing::texts::HoldsAddresses(path, pupil + std::string(link_ending))));
    DiskFiles files;
    const auto language = run::language_of_text(*text);
    const auto input = run::read_input(path, *std::move(text), language, {}, files);
    if (language != "structured" || (input && !input->has_errors()))
      add_program(path, pupil);
  }

  /// A folder among others: the work of one pupil. Unpacked archives often contain another folder.
  void add_pupil(const std::string& folder) {
    auto listing = list(folder);
    if (listing.error)
      return add_trouble(folder, name_of(folder), cannot_read(folder, listing.error));
    if (listing.programs.empty() && listing.addresses.empty())
      for (const auto& deeper : listing.folders)
        listing.take(list(deeper));
    if (listing.programs.empty() && !listing.addresses.empty()) {
      for (const auto& file : listing.addresses)
        add_addresses(file, name_of(folder));
      return;
    }
    add_handed_in(folder, name_of(folder), listing);
  }

  /// Chooses one pupil's program, if the choice is clear.
  void add_handed_in(const std::string& folder, const std::string& pupil, const Listing& listing) {
    const auto& programs = listing.programs.empty() ? listing.texts : listing.programs;
    const auto own = called_like_tests(programs);
    if (!own.empty() || programs.size() == 1) {
      for (const auto& program : own.empty() ? programs : own)
        add_program(program, pupil);
    } else if (!listing.programs.empty()) {
      add_trouble(folder, pupil,
                  say_(testing::texts::HoldsPrograms(folder, programs.size(), wanted())));
    } else {
      found_.missing.insert(folder);
      add_trouble(folder, pupil, why_none(folder, listing));
    }
  }

  /// What the folder contains in place of a program.
  std::string why_none(const std::string& folder, const Listing& listing) const {
    if (!listing.packed.empty())
      return say_(testing::texts::Packed(listing.packed.front()));
    std::vector<std::string> there;
    for (const auto& deeper : listing.folders)
      there.push_back(name_of(deeper) + "/");
    for (const auto* names : {&listing.texts, &listing.others})
      for (const auto& path : *names)
        there.push_back(name_of(path));
    if (there.empty())
      return say_(testing::texts::HoldsNone(folder, wanted()));
    if (there.size() > most_named) {
      there.resize(most_named);
      there.emplace_back("…");
    }
    return say_(
        testing::texts::HoldsOther(folder, fmt::format("{}", fmt::join(there, ", ")), wanted()));
  }

  /// Adds addresses from the playground, one pupil each, or all for `pupil` if named.
  void add_addresses(const std::string& file, const std::string& pupil) {
    const auto whose = [&](const std::string& folder) {
      return !pupil.empty() ? pupil : folder == file ? std::string(stem(file)) : name_of(folder);
    };
    const auto folders = read_link_file(file);
    if (!folders)
      return add_trouble(file, whose(file), folders.error().message);
    for (const auto& [folder, shared] : *folders) {
      if (!shared.trouble.empty()) {
        add_trouble(folder, whose(folder), shared.trouble);
        continue;
      }
      Listing listing;
      for (const auto& [name, text] : shared.files)
        if (is_program(name))
          listing.programs.push_back(folder + "/" + name);
      const bool has_main = shared.files.contains(shared.main) && is_program(shared.main);
      if (has_main && called_like_tests(listing.programs).empty())
        listing.programs = {folder + "/" + shared.main};
      add_handed_in(folder, whose(folder), listing);
    }
  }

  const std::set<std::string>& stems_;
  const Say& say_;
  HandedIn found_;
};

/// The files of addresses in a folder and in the pupils' folders.
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
                                              const std::set<std::string>& stems, const Say& say) {
  ProgramReader reader(stems, say);
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
      continue; // reported as that pupil's trouble
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
