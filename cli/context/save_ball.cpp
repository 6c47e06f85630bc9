#include "cli/context/save_ball.h"

#include "base/text/text.h"
#include "cli/context/config_file.h"
#include "cli/context/user.h"
#include "disk/disk.h"
#include "disk/lock.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

/// A line without surrounding blanks.
std::string_view trimmed(const std::string& line) {
  return trim(std::string_view(line).substr(0, line.find('\r')));
}

/// True for `[balls]`, whatever follows it.
bool opens_section(const std::string& line, std::string_view name) {
  const auto text = trimmed(line);
  return text.starts_with("[") && text.find(']') != text.npos &&
         trim(text.substr(1, text.find(']') - 1)) == name;
}

/// True if a line sets `name`: `name = …`.
bool sets(const std::string& line, std::string_view name) {
  const auto text = trimmed(line);
  const auto equals = text.find('=');
  return equals != text.npos && trim(text.substr(0, equals)) == name;
}

/// What follows the value on a line: blanks and a comment, or nothing.
std::string comment_of(const std::string& line) {
  const auto equals = line.find('=');
  const auto open = line.find_first_of("\"'", equals);
  const auto close = open == line.npos ? open : line.find(line[open], open + 1);
  const auto hash = line.find('#', close == line.npos ? equals : close);
  if (hash == line.npos)
    return {};
  return close == line.npos ? "  " + line.substr(hash) : line.substr(close + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// Returns the text with `name = "url"` in the section of balls.
std::string with_ball(const std::string& text, const std::string& name, const std::string& url) {
  auto lines = lines_of(text);
  const auto opened = std::ranges::find_if(
      lines, [](const auto& line) { return opens_section(line, balls_section); });
  const auto setting = fmt::format("{} = \"{}\"", name, url);
  if (opened == lines.end()) {
    if (!lines.empty() && !lines.back().empty())
      lines.emplace_back();
    lines.push_back(fmt::format("[{}]", balls_section));
    lines.push_back(setting);
  } else {
    const auto end = std::find_if(opened + 1, lines.end(),
                                  [](const auto& line) { return trimmed(line).starts_with("["); });
    const auto old =
        std::find_if(opened + 1, end, [&](const auto& line) { return sets(line, name); });
    if (old != end) {
      *old = setting + comment_of(*old);
    } else {
      auto after = end; // after the last line with content in the section
      while (trimmed(*(after - 1)).empty())
        --after;
      lines.insert(after, setting);
    }
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

bool same_but_for_place(const Setting& one, const Setting& other) {
  return one.section.name == other.section.name && one.option == other.option &&
         one.values == other.values;
}

/// True if both name the same robots, in any order.
bool same_balls(const Config& one, const Config& other) {
  return std::ranges::equal(one.balls, other.balls, [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.url == b.second.url && a.second.robot == b.second.robot;
  });
}

tl::unexpected<Failure> unsaved(ExitCode code, std::string message) {
  return tl::unexpected(Failure{code, std::move(message)});
}

} // namespace

bool is_ball_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_';
  });
}

tl::expected<std::string, Failure> settings_folder() {
  const auto path = user_file();
  if (!path)
    return unsaved(ExitCode::File, "there is no place for a configuration file: neither "
                                   "XDG_CONFIG_HOME nor HOME is set");
  return path->parent_path().generic_string();
}

tl::expected<std::string, Failure> save_ball(const std::string& name, const std::string& url) {
  if (!is_ball_name(name))
    return unsaved(
        ExitCode::Usage,
        fmt::format("`{}` is not a valid ball name: use letters, digits, - and _", name));
  if (url.find_first_of("\"\\\n\r") != url.npos)
    return unsaved(ExitCode::Usage,
                   fmt::format("`{}` is not allowed in a configuration file", url));
  const auto folder = settings_folder();
  if (!folder)
    return tl::unexpected(folder.error());
  const auto path = user_file();
  const auto file = path->generic_string();
  std::error_code error;
  if (fs::create_directories(disk::as_path(*folder), error); error)
    return unsaved(ExitCode::File,
                   fmt::format("cannot create the folder for {}: {}", file, error.message()));
  // Nobody else may write between our reading and our writing.
  constexpr Duration patience = 5s;
  const auto lock = disk::Lock::take(file, patience, "wait until it has finished, then save again");
  if (!lock)
    return unsaved(ExitCode::File, lock.error().message);
  std::string text;
  if (fs::exists(*path, error)) {
    auto read = disk::read(file);
    if (!read)
      return unsaved(ExitCode::File, read.error().message);
    text = *std::move(read);
  }
  const auto edited = with_ball(text, name, url);
  Config before;
  if (auto read = read_text_into(before, file, text); !read)
    return unsaved(ExitCode::Usage, read.error().message);
  before.balls[name].url = url;
  Config after; // parsed again as a check
  if (!read_text_into(after, file, edited) || !same_balls(after, before) ||
      !std::ranges::equal(after.settings, before.settings, same_but_for_place))
    return unsaved(ExitCode::Usage, fmt::format("{0}: cannot edit its `[balls]`; write "
                                                "`{1} = \"{2}\"` there",
                                                file, name, url));
  if (const auto written = disk::write(file, as_bytes(edited)); !written)
    return unsaved(ExitCode::File, written.error().message);
  return file;
}

} // namespace orb::cli
