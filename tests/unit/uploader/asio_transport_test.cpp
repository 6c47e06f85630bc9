#include "uploader/asio_transport.h"

#include <gtest/gtest.h>
#include <memory>
#include <utility>

using namespace orb::uploader;
using orb::protocol::LinkError;

namespace {

/// A stream whose operations never end, even when cancelled: models a driver that does not release
/// them.
class Deaf {
public:
  using executor_type = asio::io_context::executor_type;

  explicit Deaf(asio::io_context& io) : work_(io.get_executor()) {}

  executor_type get_executor() { return work_.get_executor(); }
  template <class Buffers, class Handler>
  void async_read_some(const Buffers&, Handler&&) {}
  template <class Buffers, class Handler>
  void async_write_some(const Buffers&, Handler&&) {}
  void cancel(asio::error_code&) {}

private:
  asio::executor_work_guard<executor_type> work_;
};

std::unique_ptr<orb::protocol::Transport> deaf() {
  auto io = std::make_unique<asio::io_context>(1);
  Deaf stream(*io);
  return std::make_unique<AsioTransport<Deaf>>(std::move(io), std::move(stream),
                                               std::chrono::milliseconds(10), [] { return 0; });
}

} // namespace

// No wait is endless, neither for an answer nor at the end of the program.
TEST(AsioTransport, AnOperationThatCannotBeCancelledBreaksTheLink) {
  const auto link = deaf();
  const auto answer = link->read(link->now());
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().kind, LinkError::Kind::Broken);
  const auto begin = link->now();
  EXPECT_FALSE(link->read(begin + std::chrono::minutes(1)));
  EXPECT_FALSE(link->write(orb::Bytes{1}));
  EXPECT_LT(link->now() - begin, cancel_time); // the link is already known to be broken
}

TEST(AsioTransport, AWriteThatCannotBeCancelledBreaksTheLink) {
  const auto link = deaf();
  const auto done = link->write(orb::Bytes{1, 2, 3});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, LinkError::Kind::Broken);
}
