#include "compiler/load.h"
#include "lively.h"
#include "vm/ball.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <malloc.h>

namespace orb::vm {
namespace {

/// Simulates ORB_SOAK_HOURS hours with 20 seeds: 24 in ./dev fuzz, a minute in ./dev test.
TEST(Trace, SoakTakesNoMemory) {
  const char* wanted = std::getenv("ORB_SOAK_HOURS");
  const Duration time = wanted ? std::atoi(wanted) * Duration{1h} : Duration{1min};
  const auto used = [] {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    BallOptions options;
    options.seed = seed;
    options.loader = compiler::load;
    Ball ball(options);
    ball.connect();
    ball.append_basic(Area::Ram, as_bytes(lively));
    ball.execute_basic(Area::Ram, 10);
    ball.advance_to(ball.now() + 10s);
    ball.take_output();
    const auto before = used();
    for (Duration passed{}; passed < time; passed += 10s) {
      ball.advance_to(ball.now() + 10s);
      ball.take_output();
    }
    EXPECT_LT(used(), before + 65536) << "seed " << seed;
    EXPECT_TRUE(ball.basic_running());
  }
}

} // namespace
} // namespace orb::vm
