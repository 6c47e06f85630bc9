// Runs programs that drive a robot over bad links, many times and in virtual time: is the robot
// ever left driving, is the report about the final stop true, and how soon does a program react?
// Prints a section of docs/inside/reliability.md; exits with 1 if a robot was left driving.
//
//   driven [--runs N]        N runs per robot and fault profile (default 100)
//   driven --runs 1000 | tests/reliability/section docs/inside/reliability.md

#include "run/tether/run_tethered.h"
#include "tests/fakes/far_robot.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace orb;

constexpr std::string_view square =
    "10 for I = 0 to 3\n20 RGB 60 * I,0,255\n30 goroll I * 90,60,1\n"
    "40 delay 700\n50 goroll I * 90,0,0\n60 delay 300\n70 next I\n80 raw 1,200,1,120\n90 delay "
    "500\n";

constexpr auto profiles = std::to_array<std::string_view>(
    {"", "drop=1%", "drop=10%", "dup=10%", "dup-request=10%", "flip=1%", "flip=10%",
     "drop=4%,dup=2%,flip=4%", "delay=50..300ms,drop=1%", "split,flip=1%", "merge,stale=8,dup=1%",
     "storm=30%,drop=1%,flip=1%", "cut@150", "cut-answer@1500"});

constexpr auto robots = std::to_array<spec::Robot>(
    {spec::Robot::Sphero, spec::Robot::Mini, spec::Robot::Bolt, spec::Robot::Rvr});

struct Nobody final : run::Listener {
  void on_event(Duration, const vm::Event&) override {}
  void on_fault(Duration, const run::ProgramError&) override {}
};

/// A virtual robot behind a bad link.
test::FarRobot robot_behind(spec::Robot which, std::string_view plan, std::uint64_t seed) {
  auto faults = *protocol::parse_fault_plan(plan.empty() ? "seed=1" : plan);
  faults.seed = seed;
  return {which, faults, 20ms};
}

struct Tally {
  int whole = 0;    ///< the program ended and the stop was acknowledged
  int reported = 0; ///< the run says why that failed
  int wrong = 0;    ///< the stop was reported as acknowledged, but the robot drives
  int left = 0;     ///< still driving 2.1 s after the last command
  Duration longest{};
};

void run_once(Tally& tally, spec::Robot which, std::string_view plan, std::uint64_t seed) {
  static const auto inputs = test::program_of(square);
  auto robot = robot_behind(which, plan, seed);
  Nobody listener;
  run::TetherOptions options;
  options.robot = which;
  const auto start = robot.ball->now();
  const auto driven = run::run_tethered(inputs, {}, listener, nullptr, *robot.link, options);
  tally.longest = std::max(tally.longest, robot.ball->now() - start);
  const bool stopped = driven && driven->ending.robot_stopped.value_or(false);
  if (stopped && robot.drives())
    ++tally.wrong;
  if (stopped && !driven->failure)
    ++tally.whole;
  else
    ++tally.reported;
  robot.live_on(2100ms); // a robot stops by itself 2 s after the last command
  if (robot.drives())
    ++tally.left;
}

/// When the last sample arrived before the stop that reacts to it was sent.
struct Watch final : protocol::Transport {
  explicit Watch(protocol::Transport& link) : inner(link) {}
  Instant now() const override { return inner.now(); }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    if (heard && !answered && is_stop(bytes))
      answered = now();
    return inner.write(bytes);
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    auto bytes = inner.read(deadline);
    if (bytes)
      reader.feed(*bytes);
    while (const auto item = reader.next())
      if (is_sample(item->packet) && !answered)
        heard = now();
    return bytes;
  }
  static bool is_sample(const protocol::PacketV2& packet) {
    const auto* message = spec::find_v2_message(packet.did, packet.cid);
    return packet.seq == spec::v2_message_seq && message != nullptr &&
           message->message == spec::V2Message::Sample;
  }
  static bool is_stop(ByteView bytes) {
    protocol::DecoderV2 reader;
    reader.feed(bytes);
    const auto item = reader.next();
    return item && item->packet.did == 0x16 && item->packet.cid == 0x07 &&
           item->packet.data.front() == 0;
  }

  protocol::Transport& inner;
  protocol::DecoderV2 reader;
  std::optional<Instant> heard;
  std::optional<Instant> answered;
};

double milliseconds(Duration time) {
  return static_cast<double>(time.count()) / 1e6;
}

/// Returns the times from a sample to the command that reacts to it, of many runs with different
/// starts.
std::vector<double> reactions(int runs) {
  std::vector<double> all;
  for (int i = 1; i <= runs; ++i) {
    const auto inputs = test::program_of(fmt::format(
        "10 delay {}\n20 goroll 0,60,1\n30 if ypos > 20 then goto 50\n40 goto 30\n50 goroll 0,0,0\n"
        "60 delay 500\n",
        i % 97 + 1));
    auto robot = robot_behind(spec::Robot::Bolt, "", static_cast<std::uint64_t>(i));
    Watch watch(*robot.link);
    Nobody listener;
    run::TetherOptions options;
    options.robot = spec::Robot::Bolt;
    if (run::run_tethered(inputs, {}, listener, nullptr, watch, options) && watch.answered)
      all.push_back(milliseconds(*watch.answered - *watch.heard));
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Returns the counts other than 0, and the longest run.
std::string cell(const Tally& tally) {
  std::string text;
  for (const auto& [count, what] :
       {std::pair{tally.whole, "whole"}, std::pair{tally.reported, "reported"},
        std::pair{tally.wrong, "wrong"}, std::pair{tally.left, "left driving"}})
    if (count > 0)
      text += fmt::format("{} {}, ", count, what);
  return text + fmt::format("{:.1f} s", milliseconds(tally.longest) / 1000);
}

std::string section(int runs, bool& bad) {
  auto page = fmt::format(R"(## Programs that drive a robot

{} runs each of a square and half a second of raw motors (`orb run square.bas --port …`) on virtual robots, over
[links with faults](../reference/links.md#faults-of-a-link). *Whole*: the program ended and the robot acknowledged the
stop. *Reported*: it could not, and the run says why. *Wrong*: the stop was reported as acknowledged, but the robot
drives. *Left driving*: it still drives 2.1 s after the last command. The time is that of the longest run.
`driven --runs 1000` repeats it.

)",
                          runs);
  page += "| profile |";
  for (const auto robot : robots)
    page += fmt::format(" {} |", spec::info(robot).title);
  page += "\n|---|---|---|---|---|\n";
  for (const auto profile : profiles) {
    page += fmt::format("| {} |", profile.empty() ? "none" : fmt::format("`{}`", profile));
    for (const auto robot : robots) {
      Tally tally;
      for (int i = 1; i <= runs; ++i)
        run_once(tally, robot, profile, static_cast<std::uint64_t>(i));
      bad |= tally.wrong + tally.left > 0;
      page += fmt::format(" {} |", cell(tally));
    }
    page += "\n";
  }
  const auto times = reactions(runs);
  bad |= times.size() != static_cast<std::size_t>(runs); // each of them reacts
  page +=
      "\nFrom a sample's arrival to the command of a program that reacts to it, in the link's time "
      "(a BOLT, which takes a\ncommand every 75 ms): ";
  for (const double limit : {1.0, 2.0, 3.0, 5.0, 20.0, 75.0}) {
    const auto share =
        100.0 *
        static_cast<double>(std::upper_bound(times.begin(), times.end(), limit) - times.begin()) /
        static_cast<double>(std::max<std::size_t>(times.size(), 1));
    const bool last = share >= 100.0 || limit >= 75.0;
    page += fmt::format("{:.1f} % within {} ms{}", share, limit, last ? ".\n" : ", ");
    if (last)
      break;
  }
  return page + "\n";
}

} // namespace

int main(int argc, char** argv) {
  int runs = 100;
  if (argc == 3 && std::string_view(argv[1]) == "--runs") {
    const std::string_view value = argv[2];
    std::from_chars(value.data(), value.data() + value.size(), runs);
  }
  bool bad = false;
  std::fputs(section(runs, bad).c_str(), stdout);
  if (bad)
    std::fputs("FAILED: a robot was left driving, or did not react\n", stderr);
  return bad ? 1 : 0;
}
