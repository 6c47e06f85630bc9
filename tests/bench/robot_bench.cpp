// Measures robots on bytes: the way from a packet to its answer, and a thousand robots that drive
// for a minute.

#include "protocol/payload_v2.h"
#include "robot/robot.h"

#include <benchmark/benchmark.h>
#include <memory>
#include <vector>

namespace {

using namespace orb;
using spec::V2Command;

Bytes packet(V2Command command, Bytes data = {}) {
  constexpr std::uint8_t seq = 7;
  return encode(protocol::make_request(command, std::move(data), seq));
}

void round_trip(benchmark::State& state) {
  robot::Robot bolt(spec::Robot::Bolt);
  bolt.connect();
  const auto ping = packet(V2Command::Ping);
  for (auto _ : state) {
    bolt.write(ping);
    bolt.advance(std::chrono::microseconds{100});
    benchmark::DoNotOptimize(bolt.read());
  }
}
BENCHMARK(round_trip);

/// The argument is a robot::Keep.
void thousand_for_a_minute(benchmark::State& state) {
  const auto wake = packet(V2Command::Wake);
  for (auto _ : state) {
    std::vector<std::unique_ptr<robot::Robot>> robots;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
      robot::Options options;
      options.seed = seed;
      options.keep = static_cast<robot::Keep>(state.range(0));
      robots.push_back(std::make_unique<robot::Robot>(spec::Robot::Bolt, options));
      robots.back()->connect();
      robots.back()->write(wake);
    }
    for (std::uint8_t second = 0; second < 60; ++second)
      for (const auto& robot : robots) {
        const auto side = static_cast<std::uint8_t>(second % 4 * 45); // degrees, less than a byte
        robot->write(packet(V2Command::DriveWithHeading, {80, 0, side, 0}));
        robot->advance(std::chrono::seconds{1});
        benchmark::DoNotOptimize(robot->read());
      }
  }
}
BENCHMARK(thousand_for_a_minute)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

} // namespace
