#include "serve/pty_link.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

namespace orb::serve {
namespace {

/// How often a pty without a client is looked at for one.
constexpr std::chrono::milliseconds interval{20};

} // namespace

PtyLink::~PtyLink() {
  if (!link_.empty())
    ::unlink(link_.c_str());
}

tl::expected<void, IoError> PtyLink::open(const std::string& link) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  std::array<char, 128> name{};
  if (master >= 0)
    stream_.assign(master);
  if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0 ||
      ::ptsname_r(master, name.data(), name.size()) != 0)
    return tl::unexpected(IoError{fmt::format("cannot open a pty: {}", std::strerror(errno))});
  slave_ = name.data();
  make_raw();
  if (link.empty())
    return {};
  struct stat status {};
  if (::lstat(link.c_str(), &status) == 0) {
    if (!S_ISLNK(status.st_mode))
      return tl::unexpected(
          IoError{fmt::format("`{}` exists and is no link; give another name", link)});
    ::unlink(link.c_str()); // left over from a run that was killed
  }
  if (::symlink(slave_.c_str(), link.c_str()) != 0)
    return tl::unexpected(
        IoError{fmt::format("cannot make link {}: {}", link, std::strerror(errno))});
  link_ = link;
  return {};
}

/// Without echo, translation and signals, and nothing left over from the client before. Opening and
/// closing the slave also brings the master into its state without a client.
void PtyLink::make_raw() const {
  const int slave = ::open(slave_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (slave < 0)
    return;
  termios settings{};
  if (::tcgetattr(slave, &settings) == 0) {
    ::cfmakeraw(&settings);
    ::tcsetattr(slave, TCSANOW, &settings);
  }
  ::tcflush(slave, TCIOFLUSH);
  ::close(slave);
}

void PtyLink::start(Door& door) {
  door_ = &door;
  if (!client_left()) {
    if (door.admits())
      return door.enter(*this); // hang_up() comes back here
    // Who writes while another client is there is not heard, now or later.
    std::array<std::uint8_t, 4096> unheard;
    while (read(unheard) > 0)
      ;
  }
  timer_.expires_after(interval);
  timer_.async_wait([this](asio::error_code error) {
    if (!error)
      start(*door_);
  });
}

void PtyLink::hang_up() {
  stream_.cancel();
  make_raw();
  start(*door_);
}

} // namespace orb::serve
