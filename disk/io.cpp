#include "disk/io.h"

#include "base/text/suggest.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace orb::disk {
namespace {

/// Suggests the file beside a missing one that was probably meant.
std::string missing_help(const std::string& path) {
  namespace fs = std::filesystem;
  const auto wanted = as_path(path);
  std::vector<std::string> names;
  std::error_code error;
  const auto folder = wanted.has_parent_path() ? wanted.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> views(names.begin(), names.end());
  if (const auto meant = closest(wanted.filename().string(), views))
    return fmt::format("; did you mean `{}`?",
                       (wanted.parent_path() / as_path(*meant)).generic_string());
  return "; check the name and the folder";
}

} // namespace

tl::unexpected<IoError> failure(std::string_view action, const std::string& path) {
  const int reason = errno;
  std::string help;
  if (reason == ENOENT && action == "read")
    help = missing_help(path);
  else if (reason == EACCES)
    help = "; check the permissions of the file and its folder";
  return tl::unexpected(
      IoError{fmt::format("cannot {} {}: {}{}", action, path, std::strerror(reason), help)});
}

namespace {

/// Larger than any input of orb. Limits devices such as /dev/zero, which never end.
constexpr std::size_t read_most = 64 * 1024 * 1024;

} // namespace

tl::expected<std::string, IoError> read_descriptor(int fd, const std::string& name) {
  std::string text;
  char buffer[65536];
  for (;;) {
    const auto n = ::read(fd, buffer, sizeof buffer);
    if (n == 0)
      return text;
    if (n > 0)
      text.append(buffer, static_cast<std::size_t>(n));
    if (text.size() > read_most)
      return tl::unexpected(
          IoError{fmt::format("cannot read {}: it is larger than {} MB; is it the right file?",
                              name, read_most >> 20)});
    if (n < 0 && errno != EINTR)
      return failure("read", name);
  }
}

bool write_all(int fd, ByteView bytes) {
  while (!bytes.empty()) {
    const auto n = ::write(fd, bytes.data(), bytes.size());
    if (n >= 0)
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    else if (errno != EINTR)
      return false;
  }
  return true;
}

std::filesystem::path as_path(std::string_view path) {
  return std::u8string(path.begin(), path.end());
}

std::string display_name(const std::string& path) {
  return path == "-" ? "<stdin>" : as_path(path).generic_string();
}

std::string target_of_links(std::string path) {
  namespace fs = std::filesystem;
  constexpr int links_most = 40; // as in the kernel
  std::error_code error;
  for (int i = 0; i < links_most && fs::is_symlink(as_path(path), error); ++i)
    path = (as_path(path).parent_path() / fs::read_symlink(as_path(path), error)).string();
  return path;
}

Draft::Draft(Draft&& other) noexcept
    : path_(std::move(other.path_)), beside_(std::exchange(other.beside_, {})),
      fd_(std::exchange(other.fd_, -1)), error_(other.error_), size_(other.size_),
      held_(std::move(other.held_)) {}

Draft& Draft::operator=(Draft&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(beside_, other.beside_);
  std::swap(fd_, other.fd_);
  std::swap(error_, other.error_);
  std::swap(size_, other.size_);
  std::swap(held_, other.held_);
  return *this;
}

void Draft::append(ByteView bytes) {
  size_ += bytes.size();
  if (fd_ < 0)
    held_.insert(held_.end(), bytes.begin(), bytes.end());
  else if (error_ == 0 && !write_all(fd_, bytes))
    error_ = errno;
}

} // namespace orb::disk
