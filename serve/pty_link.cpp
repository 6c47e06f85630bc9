#include "serve/pty_link.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <tuple>
#include <unistd.h>

namespace orb::serve {
namespace {

namespace fs = std::filesystem;

/// Polling interval of a pty without a client.
constexpr std::chrono::milliseconds interval{20};

int open_slave(const std::string& slave) {
  return ::open(slave.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
}

/// No echo, translation or signals. On Linux the settings of a master are those of its slave.
termios raw_settings(int master) {
  termios settings{};
  ::tcgetattr(master, &settings);
  ::cfmakeraw(&settings);
  return settings;
}

void keep_raw(int master) {
  termios now{};
  const auto raw = raw_settings(master);
  if (::tcgetattr(master, &now) == 0 && std::memcmp(&raw, &now, sizeof raw) != 0)
    ::tcsetattr(master, TCSANOW, &raw);
}

/// Drops what was sent to a client that left: in transit, or received but unread. Keeps what the
/// next client may already have written.
void drop_unread(int master) {
  ::tcflush(master, TCOFLUSH);
  const auto raw = raw_settings(master);
  ::tcsetattr(master, TCSAFLUSH, &raw);
}

std::string target_of(const std::string& link) {
  std::error_code error;
  return fs::read_symlink(link, error).string();
}

/// The symlink target for `slave`, in an unusual spelling that marks links of orb: a ball can
/// thereby recognise the link left by a killed ball.
std::string our_target(const std::string& slave) {
  const auto number = slave.rfind('/');
  return slave.substr(0, number) + "/." + slave.substr(number);
}

bool is_before(const timespec& a, const timespec& b) {
  return std::tie(a.tv_sec, a.tv_nsec) < std::tie(b.tv_sec, b.tv_nsec);
}

/// Returns true if a killed ball left the link: its pty is gone, or the number was given to a later
/// one.
bool is_left_over(const std::string& link) {
  const auto target = target_of(link);
  if (!target.starts_with(our_target("/dev/pts/")))
    return false;
  struct stat of_link {};
  struct stat of_pty {};
  if (::stat(target.c_str(), &of_pty) != 0)
    return true;
  return ::lstat(link.c_str(), &of_link) == 0 && is_before(of_link.st_mtim, of_pty.st_ctim);
}

IoError pty_failure(std::string_view what) {
  return {fmt::format("cannot {}: {}", what, std::strerror(errno))};
}

} // namespace

PtyLink::~PtyLink() {
  if (!path_.empty() && target_of(path_) == our_target(slave_))
    ::unlink(path_.c_str());
}

tl::expected<void, IoError> PtyLink::open() {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (master < 0)
    return tl::unexpected(pty_failure("open a pty"));
  asio::posix::stream_descriptor stream(stream_.get_executor(), master);
  std::array<char, 128> name{}; // long enough for /dev/pts/N
  if (::grantpt(master) != 0 || ::unlockpt(master) != 0 ||
      ::ptsname_r(master, name.data(), name.size()) != 0)
    return tl::unexpected(pty_failure("open a pty"));
  stream_ = std::move(stream);
  slave_ = name.data();
  keep_raw(master);
  ::close(open_slave(slave_)); // puts the master into its state without a client
  return {};
}

tl::expected<void, IoError> PtyLink::make_link(const std::string& path) {
  // The target may have the number of this pty.
  if (is_left_over(path) || target_of(path) == our_target(slave_))
    ::unlink(path.c_str());
  if (const auto target = target_of(path); !target.empty())
    return tl::unexpected(
        IoError{fmt::format("`{}` already points to {}; remove it or give another name", path,
                            fs::path(target).lexically_normal().string())});
  if (::symlink(our_target(slave_).c_str(), path.c_str()) != 0) {
    if (errno == EEXIST)
      return tl::unexpected(
          IoError{fmt::format("`{}` exists and is not a symbolic link; give another name", path)});
    return tl::unexpected(pty_failure("create link " + path));
  }
  path_ = path;
  return {};
}

void PtyLink::start(Door& door) {
  door_ = &door;
  keep_raw(stream_.native_handle()); // a silent client may have changed the settings
  if (has_visit()) {
    if (door.admits())
      return door.enter(*this); // hang_up() continues here
    // Bytes written while another client is connected are dropped.
    std::array<std::uint8_t, 4096> unheard;
    while (read(unheard) > 0)
      ;
  }
  // A silent client may have set TIOCEXCL.
  if (!has_visit() && is_exclusive())
    replace();
  timer_.expires_after(interval);
  timer_.async_wait([this](asio::error_code error) {
    if (!error)
      start(*door_);
  });
}

/// Returns true if a client is connected, or has left bytes.
bool PtyLink::has_visit() {
  pollfd query{stream_.native_handle(), POLLIN, 0};
  return ::poll(&query, 1, 0) >= 0 && ((query.revents & POLLIN) || !(query.revents & POLLHUP));
}

/// Restores the settings before each write: with echo, output would return as input.
ssize_t PtyLink::write(ByteView bytes) {
  keep_raw(stream_.native_handle());
  return DescriptorLink::write(bytes);
}

void PtyLink::hang_up() {
  stream_.cancel();
  drop_unread(stream_.native_handle());
  if (is_exclusive())
    replace();
  start(*door_);
}

/// Returns true if nobody can open the slave any more: TIOCEXCL lasts as long as the master is
/// open, and only root can clear it.
bool PtyLink::is_exclusive() {
  if (!client_left())
    return false;
  const int slave = open_slave(slave_);
  if (slave < 0)
    return errno == EBUSY && client_left();
  ::ioctl(slave, TIOCNXCL);
  ::close(slave);
  return false;
}

/// Moves to another pty and updates the symlink.
void PtyLink::replace() {
  const auto before = slave_;
  if (!open())
    return;
  if (path_.empty())
    return door_->moved(*this);
  const auto beside = path_ + ".new";
  if (target_of(path_) == our_target(before) &&
      ::symlink(our_target(slave_).c_str(), beside.c_str()) == 0)
    ::rename(beside.c_str(), path_.c_str());
}

} // namespace orb::serve
