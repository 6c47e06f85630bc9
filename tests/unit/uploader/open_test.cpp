// A link that takes no bytes, which a transcript cannot show in time.

#include "uploader/endpoint.h"

#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace orb::uploader {
namespace {

/// The master of a pty that nobody reads.
class SilentPty {
public:
  SilentPty() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ >= 0 && ::grantpt(master_) == 0 && ::unlockpt(master_) == 0)
      endpoint_ = *parse_endpoint(std::string("pty://") + ::ptsname(master_));
  }
  ~SilentPty() { ::close(master_); }
  SilentPty(const SilentPty&) = delete;
  SilentPty& operator=(const SilentPty&) = delete;

  bool is_there() const { return !endpoint_.path.empty(); }
  const Endpoint& endpoint() const { return endpoint_; }

private:
  int master_;
  Endpoint endpoint_;
};

TEST(Open, AWriteThatCannotGoOnEndsWhenAskedTo) {
  const SilentPty pty;
  if (!pty.is_there())
    GTEST_SKIP() << "no pty can be opened here";
  int looks = 0;
  const auto link = open(pty.endpoint(), Budgets{}, [&] { return ++looks < 6 ? 0 : 1; });
  ASSERT_TRUE(link.has_value()) << link.error().message;
  const Bytes more_than_fits(1 << 20);
  const auto written = (*link)->write(more_than_fits);
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().kind, protocol::LinkError::Kind::Interrupted);
  // Half a packet has been sent: cleaning up would only wait again.
  const auto again = (*link)->write(Bytes{1});
  ASSERT_FALSE(again.has_value());
  EXPECT_EQ(again.error().kind, protocol::LinkError::Kind::Broken);
  EXPECT_LT(looks, 20) << "it waited on";
}

} // namespace
} // namespace orb::uploader
