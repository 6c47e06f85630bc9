#include "serve/private_bus.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace orb::serve {
namespace {

namespace fs = std::filesystem;

constexpr auto program = "dbus-daemon";
constexpr int start_time = 10'000; // ms; it takes about ten, more on a busy machine

/// Allows everything except what is denied.
constexpr std::string_view configuration = R"(<!DOCTYPE busconfig PUBLIC
 "-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN"
 "http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd">
<busconfig>
  <listen>{}</listen>
  <auth>EXTERNAL</auth>
  <policy context="default">
    <allow user="*"/>
    <allow own="*"/>
    <allow send_destination="*" eavesdrop="true"/>
    <allow eavesdrop="true"/>
    {}
  </policy>
</busconfig>
)";

IoError failure(std::string_view what, int error) {
  return {fmt::format("cannot {}: {}", what, std::strerror(error))};
}

/// Becomes the daemon, which prints its address to `out`. Does not return.
[[noreturn]] void become_daemon(const std::string& file, int out) {
  const auto option = "--config-file=" + file;
  const auto print = "--print-address=" + std::to_string(out);
  const std::array<const char*, 6> words{program,       option.c_str(), "--nofork",
                                         "--nopidfile", print.c_str(),  nullptr};
  ::setpgid(0, 0);                    // Ctrl-C is meant for the server
  ::prctl(PR_SET_PDEATHSIG, SIGTERM); // stop it even if the server is killed
  // Discard warnings about limits that do not matter here.
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);
  ::execvp(program, const_cast<char* const*>(words.data()));
  ::_exit(1);
}

} // namespace

PrivateBus::~PrivateBus() {
  if (daemon_ > 0) {
    ::kill(daemon_, SIGTERM);
    ::waitpid(daemon_, nullptr, 0);
  }
  std::error_code ignored;
  if (!folder_.empty())
    fs::remove_all(folder_, ignored);
}

std::string PrivateBus::address() const {
  return "unix:path=" + (folder_ / "bus").string();
}

tl::expected<void, IoError> PrivateBus::start(std::string_view denied) {
  std::error_code error;
  auto name = (fs::temp_directory_path(error) / "orb-bluez-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    return tl::unexpected(failure("create a folder for a D-Bus", errno));
  folder_ = name;
  const auto rule =
      denied.empty() ? std::string() : fmt::format("<deny send_destination=\"{}\"/>", denied);
  const auto file = (folder_ / "bus.conf").string();
  if (!(std::ofstream(file) << fmt::format(fmt::runtime(configuration), address(), rule)))
    return tl::unexpected(failure("write " + file, errno));
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0)
    return tl::unexpected(failure("start a D-Bus", errno));
  daemon_ = ::fork();
  if (daemon_ == 0)
    become_daemon(file, ends[1]);
  ::close(ends[1]);
  pollfd query{ends[0], POLLIN, 0};
  std::array<char, 1> first{}; // it prints its address once it is listening
  const auto listens = daemon_ > 0 && ::poll(&query, 1, start_time) > 0 &&
                       ::read(ends[0], first.data(), first.size()) == 1;
  ::close(ends[0]);
  if (!listens)
    return tl::unexpected(IoError{"cannot start `dbus-daemon`; it is in the package of that name: "
                                  "`apt install dbus-daemon`"});
  return {};
}

} // namespace orb::serve
