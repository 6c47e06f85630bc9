#include "run/run.h"

#include "base/random.h"
#include "run/live.h"
#include "tests/random_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::run {
namespace {

/// Counts the lines and macro commands that run.
class Counter final : public Listener {
public:
  void on_event(Duration, const vm::Event& event) override {
    ran += std::holds_alternative<vm::event::Line>(event) ||
           std::holds_alternative<vm::event::Macro>(event);
  }
  void on_fault(Duration, const ProgramError&) override {}
  int ran = 0;
};

/// Writes random macros: every flag, jumps to existing and missing ids, aborts, sleeps, some too
/// long for one packet, some too long to be stored.
std::string random_macros(Random& random) {
  constexpr std::string_view commands[] = {
      "marker 7", "delay 20",   "rgb 1 2 3",  "roll 20 90 1", "goto 41", "gosub 42",
      "goto 254", "gosub 255",  "stream_end", "end",          "sleep 1", "loop 3",
      "loopend",  "goto first", ".raw 0E",    ".raw 00",      ".raw FE", "stabilization 0"};
  constexpr std::string_view flags[] = {"motor_control", "inh_if_conn", "exclusive_drv",
                                        "endsig",        "0x00",        "stop_on_disc"};
  std::string text = ".macro first";
  for (int count = 1 + static_cast<int>(random.below(3)); count > 0; --count) {
    if (random.chance(0.6))
      text += fmt::format(" id={}", random.chance(0.8) ? 40 + random.below(4) : random.below(256));
    if (random.chance(0.6))
      text += fmt::format(" flags={}", flags[random.below(std::size(flags))]);
    text += '\n';
    for (auto more = random.below(random.chance(0.1) ? 400 : 6); more > 0; --more)
      text += fmt::format("{}\n", commands[random.below(std::size(commands))]);
    text += fmt::format(".macro other_{}", count);
  }
  return text.substr(0, text.rfind(".macro"));
}

std::string random_bytes(Random& random) {
  std::string bytes;
  for (auto more = 1 + random.below(20); more > 0; --more)
    bytes += static_cast<char>(random.chance(0.3) ? 0 : random.below(256));
  return bytes;
}

tl::expected<Input, Failure> random_input(Random& random, const compiler::Target& target) {
  structured::NoFiles files;
  switch (random.below(4)) {
  case 0: {
    testing::RandomProgram::Style style;
    style.lines = 1 + static_cast<int>(random.below(8));
    style.broken = 0.2;
    return read_input("a.bas", testing::RandomProgram(random.next(), style).write(), "", target,
                      files);
  }
  case 1: return read_input("a.sphero", random_bytes(random), "", target, files);
  case 2: return read_input("a.bin", random_bytes(random), "", target, files);
  default: return read_input("a.macro", random_macros(random), "", target, files);
  }
}

Options random_options(Random& random) {
  Options options;
  options.trace_lines = true;
  options.bound = 1s;
  options.seed = random.next();
  options.client = random.chance(0.5) ? Client::Absent : Client::Connected;
  options.firmware = spec::firmwares[random.below(std::size(spec::firmwares))].firmware;
  if (random.chance(0.2))
    options.line = static_cast<std::uint16_t>(random.below(90));
  if (random.chance(0.2))
    options.ram_bytes = 1024;
  if (random.chance(0.3))
    options.target.area = spec::Area::Flash;
  return options;
}

// Exit code 0 is reliable: something ran, or the reason why not is printed.
RC_GTEST_PROP(Run, NeverSucceedsWithNothingRunAndNothingSaid, ()) {
  Random random{*rc::gen::arbitrary<std::uint64_t>()};
  const auto options = random_options(random);
  std::vector<Input> inputs;
  for (auto more = 1 + random.below(3); more > 0; --more)
    if (auto input = random_input(random, options.target); input && !input->has_errors())
      inputs.push_back(*std::move(input));
  for (const auto& input : inputs)
    RC_LOG() << input.source->name() << " is " << to_hex(as_bytes(input.source->text())) << '\n';
  Counter counter;
  const auto ending = run(inputs, options, counter, nullptr);
  if (!ending) {
    RC_ASSERT(!ending.error().message.empty());
    RC_ASSERT(ending.error().code != ExitCode::Done);
    RC_CLASSIFY(true, "refused");
    return;
  }
  RC_CLASSIFY(ending->faults.empty() && ending->aborted.empty(), "success");
  RC_CLASSIFY(!ending->aborted.empty(), "aborted");
  if (ending->faults.empty() && ending->aborted.empty())
    RC_ASSERT(counter.ran > 0);
}

/// Collects prints.
class Prints final : public Listener {
public:
  void on_event(Duration, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      text += print->text;
  }
  void on_fault(Duration, const ProgramError&) override {}
  std::string text;
};

// Position reports while it waits do not end the run.
TEST(Live, ANumberThatIsWaitedForIsTakenHoweverLate) {
  structured::NoFiles files;
  Options options;
  options.bound = Duration::max() / 2;
  options.until = Until::Rest;
  std::vector<Input> inputs;
  inputs.push_back(*read_input("a.bas", "10 goroll 0,90,1\n20 input A\n30 print \"got \" A\n", "",
                               options.target, files));
  Prints prints;
  auto live = *Live::start(inputs, options, prints, nullptr);
  live->keep_waiting();
  while (live->time() < 2s)
    if (!live->advance(2s)) {
      ASSERT_TRUE(live->waits_for_number());
      live->wait(live->time() + 50ms);
    }
  live->give(42);
  while (live->time() < 9s && live->advance(9s)) {
  }
  EXPECT_EQ(prints.text, "got 42\n");
  const auto ending = live->finish();
  ASSERT_TRUE(ending.has_value());
  EXPECT_EQ(ending->lines, 3U);
}

} // namespace
} // namespace orb::run
