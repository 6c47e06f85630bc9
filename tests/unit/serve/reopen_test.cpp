// Clients open and close a pty as fast as they can: each must reach a ball that answers it alone.
// ORB_REOPENINGS sets how often (tests/reliability/reopen takes more, on a busy machine).

#include "serve/server.h"

#include "protocol/packet.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace orb::serve {
namespace {

/// A ball on a pty, in a separate process.
class Served {
public:
  Served() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0)
      return;
    process_ = ::fork();
    if (process_ == 0) {
      ServeOptions options;
      options.pty = true;
      options.announce = [&](std::string_view line) {
        if (::write(ends[1], line.data(), line.size()) < 0)
          ::_exit(1);
      };
      options.warn = [](std::string_view) {};
      ::close(ends[0]);
      ::_exit(serve(options) ? 0 : 1);
    }
    ::close(ends[1]);
    std::array<char, 64> line{};
    const auto size = ::read(ends[0], line.data(), line.size());
    ::close(ends[0]);
    if (size > 5) // `pty /dev/pts/4` and a line end; empty if no pty can be opened
      path = std::string(line.data() + 4, static_cast<std::size_t>(size) - 5);
  }
  ~Served() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  std::string path;

private:
  pid_t process_ = -1;
};

/// Reads up to `size` bytes within ten seconds.
Bytes answer(int fd, std::size_t size) {
  Bytes bytes(size);
  std::size_t count = 0;
  for (pollfd query{fd, POLLIN, 0}; count<size&& ::poll(&query, 1, 10'000)> 0;) {
    const auto got = ::read(fd, bytes.data() + count, size - count);
    if (got <= 0)
      break;
    count += static_cast<std::size_t>(got);
  }
  bytes.resize(count);
  return bytes;
}

TEST(Reopening, EveryClientOfAPtyIsAnswered) {
  const Served ball;
  if (ball.path.empty())
    GTEST_SKIP() << "no pty can be opened here";
  const char* wanted = std::getenv("ORB_REOPENINGS");
  const int times = wanted != nullptr ? std::atoi(wanted) : 100;
  for (int i = 0; i < times; ++i) {
    auto ping = protocol::make_command(spec::ApiCommand::Ping);
    ping.seq = static_cast<std::uint8_t>(i);
    const auto bytes = encode(ping);
    const int fd = ::open(ball.path.c_str(), O_RDWR | O_NOCTTY);
    ASSERT_GE(fd, 0);
    ASSERT_EQ(::write(fd, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    const auto heard = answer(fd, 6);
    ::close(fd);
    ASSERT_EQ(heard.size(), 6U) << "visit " << i << " was not answered";
    ASSERT_EQ(heard[3], ping.seq) << "visit " << i << " got another one's answer";
  }
}

} // namespace
} // namespace orb::serve
