#include "serve/pty_link.h"

#include <array>
#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

namespace orb::serve {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Admits one client at a time and never answers.
struct Hall final : Door {
  bool admits() override { return !visited; }
  void enter(Link&) override { visited = true; }
  void moved(const Link& link) override { moved_to = link.address(); }
  bool visited = false;
  std::string moved_to;
};

/// A temporary folder, removed at the end.
struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "orb-pty.XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

/// Opens the target of an address such as `pty /dev/pts/4`.
int open_at(const std::string& address) {
  return ::open(address.substr(4).c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
}

class PtyLinkTest : public testing::Test {
protected:
  void SetUp() override {
    if (const auto opened = link.open(); !opened)
      GTEST_SKIP() << opened.error().message;
    link.start(hall);
  }

  int open_slave() const { return open_at(link.address()); }
  /// Polls the pty until a client has entered.
  bool visited() {
    for (const auto end = std::chrono::steady_clock::now() + 5s;
         !hall.visited && std::chrono::steady_clock::now() < end;)
      io.run_one_until(end);
    return hall.visited;
  }
  void hang_up() {
    hall.visited = false;
    link.hang_up();
  }
  std::string heard() {
    std::array<std::uint8_t, 64> buffer{};
    const auto size = link.read(buffer);
    return {buffer.begin(), buffer.begin() + std::max<ssize_t>(0, size)};
  }

  asio::io_context io{1};
  asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
  Hall hall;
  PtyLink link{io};
};

void say(int fd, std::string_view text) {
  ASSERT_EQ(::write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

std::string read_now(int fd) {
  std::array<char, 64> buffer{};
  return {buffer.data(),
          static_cast<std::size_t>(std::max<ssize_t>(0, ::read(fd, buffer.data(), 64)))};
}

TEST_F(PtyLinkTest, KeepsWhatTheNextClientHasWrittenAlready) {
  const int first = open_slave();
  ASSERT_TRUE(visited());
  ::close(first);
  const int second = open_slave();
  say(second, "ping");
  hang_up();
  EXPECT_TRUE(hall.visited);
  EXPECT_EQ(heard(), "ping");
  ::close(second);
}

TEST_F(PtyLinkTest, DropsWhatTheClientBeforeHasNotRead) {
  const int first = open_slave();
  ASSERT_TRUE(visited());
  link.write(as_bytes("answer"));
  ::close(first);
  hang_up();
  const int second = open_slave();
  EXPECT_EQ(read_now(second), "");
  ::close(second);
}

TEST_F(PtyLinkTest, HearsAVisitThatIsOverBeforeItIsLookedAt) {
  const int fd = open_slave();
  say(fd, "ping");
  ::close(fd);
  ASSERT_TRUE(visited());
  EXPECT_EQ(heard(), "ping");
}

void make_sane(int fd) {
  termios settings{};
  ::tcgetattr(fd, &settings);
  settings.c_lflag |= ECHO | ICANON;
  settings.c_oflag |= OPOST | ONLCR;
  ASSERT_EQ(::tcsetattr(fd, TCSANOW, &settings), 0);
}

TEST_F(PtyLinkTest, HearsNoEchoOfItself) {
  const int fd = open_slave();
  ASSERT_TRUE(visited());
  make_sane(fd);
  link.write(as_bytes("answer"));
  EXPECT_EQ(heard(), "");
  EXPECT_EQ(read_now(fd), "answer");
  ::close(fd);
}

bool is_raw(int fd) {
  termios settings{};
  ::tcgetattr(fd, &settings);
  return (settings.c_lflag & (ECHO | ICANON)) == 0 && (settings.c_oflag & OPOST) == 0;
}

TEST_F(PtyLinkTest, IsRawAgainAfterAVisitThatSaidNothing) {
  int fd = open_slave();
  make_sane(fd);
  ::close(fd);
  fd = open_slave();
  for (const auto end = std::chrono::steady_clock::now() + 5s;
       !is_raw(fd) && std::chrono::steady_clock::now() < end;)
    io.run_one_until(end);
  EXPECT_TRUE(is_raw(fd));
  ::close(fd);
}

/// Runs `body` in a process of an ordinary user, because root may do too much. Returns its result.
bool as_ordinary_user(const std::function<bool()>& body) {
  constexpr uid_t nobody = 65534;
  const auto child = ::fork();
  if (child == 0) {
    if (::getuid() == 0 && ::setresuid(nobody, nobody, nobody) != 0)
      ::_exit(2);
    ::_exit(body() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Returns true if a second client can enter after one that set TIOCEXCL. The address may change in
/// between.
bool lets_in_after_exclusive(const std::string& link_path) {
  asio::io_context io{1};
  const auto work = asio::make_work_guard(io);
  Hall hall;
  PtyLink link(io);
  if (!link.open() || (!link_path.empty() && !link.make_link(link_path)))
    return false;
  link.start(hall);
  const int first = open_at(link.address());
  if (first < 0 || ::ioctl(first, TIOCEXCL) != 0)
    return false;
  while (!hall.visited)
    io.run_one_for(5s);
  ::close(first);
  hall.visited = false;
  link.hang_up();
  const int second = open_at(link.address());
  while (second >= 0 && !hall.visited)
    io.run_one_for(5s);
  return second >= 0 && hall.moved_to == (link_path.empty() ? link.address() : "");
}

TEST(PtyLinkOfAnOrdinaryUser, LetsTheNextOneInAfterAnExclusiveClient) {
  asio::io_context io{1};
  if (!PtyLink(io).open())
    GTEST_SKIP() << "no pty can be opened here";
  EXPECT_TRUE(as_ordinary_user([] { return lets_in_after_exclusive(""); }));
  EXPECT_TRUE(as_ordinary_user([] {
    const Folder folder;
    const auto place = folder.path / "ball";
    return lets_in_after_exclusive(place) && !fs::is_symlink(place);
  }));
}

/// Returns true if a client can enter after a silent one that set TIOCEXCL.
bool lets_in_after_silent_exclusive() {
  asio::io_context io{1};
  const auto work = asio::make_work_guard(io);
  Hall hall;
  PtyLink link(io);
  if (!link.open())
    return false;
  link.start(hall);
  const int silent = open_at(link.address());
  if (silent < 0 || ::ioctl(silent, TIOCEXCL) != 0)
    return false;
  ::close(silent); // before the poll has seen it
  for (int i = 0; i < 200; ++i) {
    const int second = open_at(link.address());
    while (second >= 0 && !hall.visited)
      io.run_one_for(5s);
    if (second >= 0)
      return true;
    io.run_one_for(20ms);
  }
  return false;
}

TEST(PtyLinkOfAnOrdinaryUser, LetsTheNextOneInAfterAnExclusiveClientThatSaidNothing) {
  asio::io_context io{1};
  if (!PtyLink(io).open())
    GTEST_SKIP() << "no pty can be opened here";
  EXPECT_TRUE(as_ordinary_user(lets_in_after_silent_exclusive));
}

TEST_F(PtyLinkTest, ReplacesNothingButTheLinkOfABallThatWasKilled) {
  const Folder folder;
  const auto file = folder.path / "file";
  std::ofstream(file) << "mine";
  EXPECT_FALSE(link.make_link(file));
  const auto elsewhere = folder.path / "elsewhere";
  fs::create_symlink(file, elsewhere);
  EXPECT_FALSE(link.make_link(elsewhere));
  EXPECT_EQ(fs::read_symlink(elsewhere), file);
  const auto living = folder.path / "living";
  const auto slave = link.address().substr(4);
  fs::create_symlink(slave, living);
  PtyLink second(io);
  ASSERT_TRUE(second.open());
  EXPECT_FALSE(second.make_link(living));
  EXPECT_EQ(fs::read_symlink(living), slave);
  const auto foreign = folder.path / "foreign"; // belongs to a program that may come back
  fs::create_symlink("/dev/pts/2000000000", foreign);
  EXPECT_FALSE(second.make_link(foreign));
  EXPECT_EQ(fs::read_symlink(foreign), "/dev/pts/2000000000");
  const auto dead = folder.path / "dead";
  fs::create_symlink("/dev/pts/./2000000000", dead); // in the spelling of a ball
  const auto made = second.make_link(dead);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
}

TEST_F(PtyLinkTest, ReplacesALinkToAPtyThatCameAfterIt) {
  const Folder folder;
  const auto place = folder.path / "ball";
  const auto slave = fs::path(link.address().substr(4));
  fs::create_symlink("/dev/pts/." / fs::path(slave.filename()), place);
  PtyLink second(io);
  ASSERT_TRUE(second.open());
  EXPECT_FALSE(second.make_link(place)); // belongs to a running ball
  const std::array<timespec, 2> long_ago{};
  ASSERT_EQ(::utimensat(AT_FDCWD, place.c_str(), long_ago.data(), AT_SYMLINK_NOFOLLOW), 0);
  EXPECT_TRUE(second.make_link(place)); // the number was given to another program
}

TEST_F(PtyLinkTest, LeavesALinkThatSomebodyElseHasMade) {
  const Folder folder;
  const auto place = folder.path / "ball";
  {
    PtyLink second(io);
    ASSERT_TRUE(second.open());
    ASSERT_TRUE(second.make_link(place));
    fs::remove(place);
    fs::create_symlink("elsewhere", place);
  }
  EXPECT_EQ(fs::read_symlink(place), "elsewhere");
}

} // namespace
} // namespace orb::serve
