#include "uploader/endpoint.h"

#include "base/random.h"
#include "uploader/upload.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace orb::uploader {
namespace {

/// Closes a file descriptor at the end of the scope.
struct Handle {
  explicit Handle(int opened) : fd(opened) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_now(); }
  void close_now() {
    if (fd >= 0)
      ::close(std::exchange(fd, -1));
  }
  int fd;
};

/// The master of a pseudo-terminal, and the path for a client.
struct Pty {
  Pty() : master(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (::grantpt(master.fd) == 0 && ::unlockpt(master.fd) == 0)
      path = ::ptsname(master.fd);
  }
  Handle master;
  std::string path;
};

/// Tests of ptys, skipped where there are none.
class PtyTest : public testing::Test {
protected:
  void SetUp() override {
    if (Pty().path.empty())
      GTEST_SKIP() << "no pty can be opened here";
  }
};

bool on_and_on() {
  return false;
}

Endpoint endpoint_of(std::string_view url) {
  const auto endpoint = parse_endpoint(url);
  EXPECT_TRUE(endpoint.has_value()) << url;
  return endpoint.value_or(Endpoint{});
}

std::string open_error(std::string_view url) {
  const auto opened = open(endpoint_of(url), Budgets{}, on_and_on);
  EXPECT_FALSE(opened.has_value()) << url;
  return opened ? std::string() : opened.error().message;
}

Duration steady_time() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

TEST(Endpoint, ReadsEachForm) {
  EXPECT_EQ(endpoint_of("sim:").scheme, Scheme::Sim);
  EXPECT_EQ(endpoint_of("/dev/rfcomm0").scheme, Scheme::Serial);
  EXPECT_EQ(endpoint_of("serial:///dev/rfcomm0").path, "/dev/rfcomm0");
  EXPECT_EQ(endpoint_of("pty:///dev/pts/4").path, "/dev/pts/4");
  EXPECT_EQ(endpoint_of("replay://a/b.txt").path, "a/b.txt");
  const auto tcp = endpoint_of("tcp://[::1]:4242");
  EXPECT_EQ(tcp.host, "::1");
  EXPECT_EQ(tcp.port, 4242);
  const auto radio = endpoint_of("rfcomm://68:86:E7:00:11:22/3");
  EXPECT_EQ(radio.address, (BluetoothAddress{0x68, 0x86, 0xE7, 0x00, 0x11, 0x22}));
  EXPECT_EQ(radio.channel, 3);
  EXPECT_EQ(endpoint_of("rfcomm://68:86:e7:00:11:22").channel, 1);
}

TEST(Endpoint, SaysWhatIsWrong) {
  for (const auto* url :
       {"", "foo", "tcp://", "tcp://host", "tcp://host:0", "tcp://host:99999", "tcp://:1",
        "tpc://h:1", "rfcomm://", "rfcomm://68:86", "rfcomm://68:86:E7:00:11:2G",
        "rfcomm://68-86-E7-00-11-22", "rfcomm://68:86:E7:00:11:22/0",
        "rfcomm://68:86:E7:00:11:22/31", "serial://", "http://x"}) {
    const auto endpoint = parse_endpoint(url);
    ASSERT_FALSE(endpoint.has_value()) << url;
    EXPECT_NE(endpoint.error().find("is not a port"), std::string::npos) << endpoint.error();
  }
  EXPECT_NE(parse_endpoint("tpc://h:1").error().find("did you mean `tcp://`?"), std::string::npos);
}

TEST(Endpoint, WritesTheBluetoothAddressAsTheKernelReadsIt) {
  const auto bytes = rfcomm_socket_address({0x68, 0x86, 0xE7, 0x00, 0x11, 0x22}, 1);
  sa_family_t family = 0;
  std::memcpy(&family, bytes.data(), sizeof(family));
  EXPECT_EQ(family, AF_BLUETOOTH);
  EXPECT_EQ(to_hex(ByteView(bytes).subspan(2)), "22 11 00 E7 86 68 01 00");
}

TEST(Endpoint, SaysWhatHelps) {
  const auto serial = endpoint_of("/dev/rfcomm0");
  EXPECT_EQ(describe_open_error(serial, EACCES).message,
            "cannot open /dev/rfcomm0: permission denied; add yourself to group `dialout`: `sudo "
            "usermod -aG dialout $USER`, then log in again");
  EXPECT_NE(describe_open_error(serial, EBUSY).message.find("fuser"), std::string::npos);
  const auto radio = endpoint_of("rfcomm://68:86:E7:00:11:22");
  EXPECT_NE(describe_open_error(radio, EAFNOSUPPORT).message.find("no Bluetooth sockets"),
            std::string::npos);
  EXPECT_NE(describe_open_error(radio, EHOSTDOWN).message.find("shake"), std::string::npos);
}

TEST(Open, NamesWhatIsNoDevice) {
  EXPECT_NE(open_error("/nonexistent/rfcomm0").find("no such file"), std::string::npos);
  EXPECT_NE(open_error("/tmp").find("is a directory; give the path of a device"),
            std::string::npos);
  EXPECT_NE(open_error("/dev/null").find("not a serial device"), std::string::npos);
  EXPECT_NE(open_error("tcp://127.0.0.1:1").find("nothing is listening there"), std::string::npos);
}

TEST_F(PtyTest, CarriesBytesThroughAPtyUnchanged) {
  Pty pty;
  auto link = open(endpoint_of("pty://" + pty.path), Budgets{}, on_and_on);
  ASSERT_TRUE(link.has_value()) << link.error().message;
  Bytes all(256);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = static_cast<std::uint8_t>(i);
  ASSERT_TRUE((*link)->write(all).has_value());
  Bytes arrived;
  while (arrived.size() < all.size()) {
    std::array<std::uint8_t, 300> buffer{};
    const auto size = ::read(pty.master.fd, buffer.data(), buffer.size());
    ASSERT_GT(size, 0);
    arrived.insert(arrived.end(), buffer.begin(), buffer.begin() + size);
  }
  EXPECT_EQ(arrived, all);
  ASSERT_EQ(::write(pty.master.fd, all.data(), all.size()), static_cast<ssize_t>(all.size()));
  Bytes back;
  while (back.size() < all.size()) {
    const auto read = (*link)->read((*link)->now() + 2s);
    ASSERT_TRUE(read.has_value());
    ASSERT_FALSE(read->empty());
    back.insert(back.end(), read->begin(), read->end());
  }
  EXPECT_EQ(back, all);
}

TEST_F(PtyTest, WaitsNoLongerThanTheDeadline) {
  Pty pty;
  auto link = open(endpoint_of(pty.path), Budgets{}, on_and_on);
  ASSERT_TRUE(link.has_value());
  const auto start = steady_time();
  const auto read = (*link)->read((*link)->now() + 30ms);
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(read->empty());
  EXPECT_GE(steady_time() - start, 30ms);
  EXPECT_LT(steady_time() - start, 500ms);
}

TEST_F(PtyTest, NoticesThatTheOtherEndHungUp) {
  Pty pty;
  auto link = open(endpoint_of(pty.path), Budgets{}, on_and_on);
  ASSERT_TRUE(link.has_value());
  pty.master.close_now();
  const auto start = steady_time();
  const auto read = (*link)->read((*link)->now() + 10s);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().kind, protocol::LinkError::Kind::Closed);
  EXPECT_LT(steady_time() - start, 1s);
}

TEST_F(PtyTest, RefusesAPortInUse) {
  Pty pty;
  const auto first = open(endpoint_of(pty.path), Budgets{}, on_and_on);
  ASSERT_TRUE(first.has_value());
  EXPECT_NE(open_error(pty.path).find("another program has it open"), std::string::npos);
}

/// Root can open what others cannot.
TEST_F(PtyTest, LetsAnOrdinaryUserInAgain) {
  constexpr uid_t nobody = 65534;
  const auto child = ::fork();
  if (child == 0) {
    if (::getuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0)
      ::_exit(2);
    const Pty pty;
    const auto endpoint = *parse_endpoint(pty.path);
    for (int visit = 0; visit < 3; ++visit)
      if (!open(endpoint, Budgets{}, on_and_on))
        ::_exit(1);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

/// A listening port of this machine.
struct Listener {
  explicit Listener(int queue) : socket(::socket(AF_INET, SOCK_STREAM, 0)) {
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    EXPECT_EQ(::bind(socket.fd, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(socket.fd, queue), 0);
    ::getsockname(socket.fd, reinterpret_cast<sockaddr*>(&address), &size);
  }
  Endpoint endpoint() const {
    return endpoint_of("tcp://127.0.0.1:" + std::to_string(ntohs(address.sin_port)));
  }
  Handle socket;
  sockaddr_in address{};
};

TEST(Open, ConnectsOverTcp) {
  const Listener listener(1);
  auto link = open(listener.endpoint(), Budgets{}, on_and_on);
  ASSERT_TRUE(link.has_value()) << link.error().message;
  Handle peer(::accept(listener.socket.fd, nullptr, nullptr));
  ASSERT_TRUE((*link)->write(Bytes{1, 2, 3}).has_value());
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(::read(peer.fd, buffer.data(), buffer.size()), 3);
  ASSERT_EQ(::write(peer.fd, buffer.data(), 3), 3);
  EXPECT_EQ((*link)->read((*link)->now() + 2s)->size(), 3U);
  peer.close_now();
  const auto read = (*link)->read((*link)->now() + 10s);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().kind, protocol::LinkError::Kind::Closed);
}

TEST(Open, StopsConnectingWhenAsked) {
  const Listener listener(0);
  // Fills the queue: the next client has to wait.
  const Handle first(::socket(AF_INET, SOCK_STREAM, 0));
  ASSERT_EQ(::connect(first.fd, reinterpret_cast<const sockaddr*>(&listener.address),
                      sizeof(listener.address)),
            0);
  int asked = 0;
  const auto link = open(listener.endpoint(), Budgets{}, [&] { return ++asked > 5; });
  ASSERT_FALSE(link.has_value());
  EXPECT_EQ(link.error().kind, protocol::LinkError::Kind::Interrupted);
  EXPECT_EQ(link.error().message, "interrupted; the ball is unchanged");
}

TEST(Open, DoesNotWaitForANameOnceStopped) {
  const auto link = open(endpoint_of("tcp://ball.invalid:1"), Budgets{}, [] { return true; });
  ASSERT_FALSE(link.has_value());
  EXPECT_EQ(link.error().kind, protocol::LinkError::Kind::Interrupted);
}

/// Budgets short enough for a test in real time.
Budgets hurried() {
  Budgets budgets;
  budgets.answer = 20ms;
  budgets.drain = 10ms;
  budgets.backoff_first = 1ms;
  budgets.backoff_most = 2ms;
  return budgets;
}

/// Greets the `talker` on the master of a pty, which receives what the client sent.
Report greet_talker(const std::function<Bytes(ByteView)>& talker) {
  Pty pty;
  auto link = open(endpoint_of(pty.path), hurried(), on_and_on);
  EXPECT_TRUE(link.has_value());
  ::fcntl(pty.master.fd, F_SETFL, O_NONBLOCK);
  std::atomic<bool> over = false;
  std::thread thread([&] {
    while (!over) {
      std::array<std::uint8_t, 256> buffer{};
      pollfd poll{pty.master.fd, POLLIN, 0};
      ::poll(&poll, 1, 1);
      const auto size = std::max<ssize_t>(0, ::read(pty.master.fd, buffer.data(), buffer.size()));
      const auto reply = talker(ByteView(buffer).first(static_cast<std::size_t>(size)));
      if (!reply.empty() && ::write(pty.master.fd, reply.data(), reply.size()) < 0 &&
          errno != EAGAIN)
        return;
    }
  });
  Session session(**link, hurried(), 0x31);
  const auto start = steady_time();
  const auto greeting = greet(session);
  over = true;
  thread.join();
  EXPECT_LT(steady_time() - start, 2s);
  EXPECT_FALSE(greeting.has_value());
  return greeting ? Report{} : greeting.error();
}

TEST_F(PtyTest, GreetingEndsInTimeWithATalkerThatIsNoBall) {
  const auto echo = greet_talker([](ByteView sent) { return Bytes(sent.begin(), sent.end()); });
  EXPECT_EQ(echo.kind, Report::Kind::NoBall);
  EXPECT_NE(echo.message.find("echo"), std::string::npos) << echo.message;
  Random random{7};
  const auto noise = greet_talker([&](ByteView) {
    Bytes bytes(64);
    for (auto& byte : bytes)
      byte = static_cast<std::uint8_t>(random.next());
    return bytes;
  });
  EXPECT_EQ(noise.kind, Report::Kind::NoBall);
  EXPECT_NE(noise.message.find("not a ball"), std::string::npos) << noise.message;
  const auto shell = greet_talker([](ByteView sent) {
    const std::string_view prompt = "sh: not found\n$ ";
    return sent.empty() ? Bytes{} : Bytes(prompt.begin(), prompt.end());
  });
  EXPECT_EQ(shell.kind, Report::Kind::NoBall);
  const auto silence = greet_talker([](ByteView) { return Bytes{}; });
  EXPECT_EQ(silence.kind, Report::Kind::NoBall);
  EXPECT_NE(silence.message.find("awake"), std::string::npos) << silence.message;
}

} // namespace
} // namespace orb::uploader
