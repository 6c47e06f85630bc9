// Measures how fast `orb ball` answers on loopback. ORB names the program; by default the one
// beside this benchmark.

#include "protocol/packet.h"

#include <arpa/inet.h>
#include <array>
#include <benchmark/benchmark.h>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <netinet/tcp.h>
#include <string>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using namespace orb;

std::string orb_program() {
  if (const auto* name = std::getenv("ORB"))
    return name;
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "orb").string();
}

/// An `orb ball` process with its ports.
class Server {
public:
  explicit Server(int balls) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0)
      return;
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      const auto program = orb_program();
      const auto count = std::to_string(balls);
      ::execl(program.c_str(), "orb", "ball", "--tcp", "127.0.0.1:0", "--count", count.c_str(),
              nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    auto* lines = ::fdopen(ends[0], "r");
    int port = 0;
    while (static_cast<int>(ports.size()) < balls &&
           std::fscanf(lines, " tcp 127.0.0.1:%d", &port) == 1)
      ports.push_back(port);
    std::fclose(lines);
  }
  ~Server() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Returns the processor time so far, in seconds.
  double cpu_s() const {
    std::FILE* file = std::fopen(("/proc/" + std::to_string(process_) + "/stat").c_str(), "r");
    if (file == nullptr)
      return 0;
    long user = 0, system = 0;
    const auto found = std::fscanf(
        file, "%*d %*s %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %ld %ld", &user, &system);
    std::fclose(file);
    return found == 2
               ? static_cast<double>(user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK))
               : 0;
  }

  std::vector<int> ports;

private:
  pid_t process_ = -1;
};

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ? fd : -1;
}

/// Keeps 64 pings in flight: every answer triggers the next ping.
void Pings64InFlight(benchmark::State& state) {
  constexpr std::size_t window = 64;
  constexpr std::size_t answer_size = 6;
  Server server(1);
  const int fd = server.ports.empty() ? -1 : connect_to(server.ports[0]);
  if (fd < 0)
    return state.SkipWithError("orb ball cannot be reached");
  const auto ping = encode(protocol::make_command(spec::ApiCommand::Ping));
  Bytes pings;
  for (std::size_t i = 0; i < window; ++i)
    pings.insert(pings.end(), ping.begin(), ping.end());
  Bytes answers(window * answer_size);
  std::size_t received = 0, answered = 0;
  bool alive = ::send(fd, pings.data(), pings.size(), 0) == static_cast<ssize_t>(pings.size());
  for (auto _ : state) {
    const auto got = ::recv(fd, answers.data(), answers.size(), 0);
    if (!alive || got <= 0)
      return state.SkipWithError("the ball hung up");
    received += static_cast<std::size_t>(got);
    const auto fresh = received / answer_size;
    received %= answer_size;
    answered += fresh;
    const auto bytes = fresh * ping.size();
    alive = ::send(fd, pings.data(), bytes, 0) == static_cast<ssize_t>(bytes);
  }
  state.counters["pings"] =
      benchmark::Counter(static_cast<double>(answered), benchmark::Counter::kIsRate);
  ::close(fd);
}
BENCHMARK(Pings64InFlight)->UseRealTime()->MinTime(2);

/// Measures the share of a core that 200 balls take at 20 commands a second each, for five seconds.
void TwoHundredBalls(benchmark::State& state) {
  constexpr int balls = 200;
  constexpr int per_second = 20;
  Server server(balls);
  std::vector<int> fds;
  for (const auto port : server.ports)
    fds.push_back(connect_to(port));
  if (fds.size() != balls)
    return state.SkipWithError("orb ball cannot be reached");
  const auto roll = encode(protocol::make_command(spec::ApiCommand::Roll, {100, 0, 90, 1}));
  const auto before = server.cpu_s();
  std::size_t answered = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    for (int round = 0; round < 5 * per_second; ++round) {
      std::this_thread::sleep_until(start + std::chrono::milliseconds{1000 * round / per_second});
      for (const auto fd : fds)
        if (::send(fd, roll.data(), roll.size(), 0) < 0)
          return state.SkipWithError("a ball hung up");
      for (const auto fd : fds) {
        std::array<std::uint8_t, 6> answer{};
        answered += ::recv(fd, answer.data(), answer.size(), MSG_WAITALL) == 6;
      }
    }
  }
  const auto seconds = static_cast<double>(answered) / (balls * per_second);
  state.counters["answers"] = static_cast<double>(answered);
  state.counters["core"] = (server.cpu_s() - before) / seconds;
  for (const auto fd : fds)
    ::close(fd);
}
BENCHMARK(TwoHundredBalls)->Iterations(1)->UseRealTime();

} // namespace
