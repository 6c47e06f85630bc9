#include "cli/run/run_options.h"

#include "base/duration.h"
#include "base/refuse.h"
#include "cli/input/inputs.h"
#include "cli/robot/ball_profile.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace orb::cli {
namespace {

/// Reads `1,2,-3`; nothing if it is not a list of 32-bit numbers.
std::optional<std::vector<std::int32_t>> read_numbers(std::string_view text) {
  std::vector<std::int32_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    std::int32_t value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{})
      return std::nullopt;
    numbers.push_back(value);
    if (next == end)
      return numbers;
    if (*next != ',')
      return std::nullopt;
    at = next + 1;
  }
}

} // namespace

tl::expected<run::Options, Failure> read_options(const Context& context, const RunOptions& given) {
  auto options = given.run;
  const auto time = parse_duration(given.time, 1s);
  if (!time)
    return refuse(ExitCode::Usage,
                  fmt::format("`--for {}` is not a duration; write it like 90s, 500ms "
                              "or 2min",
                              given.time));
  options.bound = *time;
  if (!given.input.empty() && given.input != from_stdin) {
    auto numbers = read_numbers(given.input);
    if (!numbers)
      return refuse(
          ExitCode::Usage,
          fmt::format("`--input {}` is not a list of numbers such as 1,2,3", given.input));
    options.numbers = *std::move(numbers);
  }
  options.firmware = spec::find_firmware(given.firmware)->firmware; // the options have been checked
  if (!given.robot.empty())
    options.model = spec::find_robot(given.robot)->robot;
  if (!given.ball.empty()) {
    const auto profile = read_profile(given.ball, given.robot);
    if (!profile)
      return tl::unexpected(profile.error());
    options.drive_like(*profile);
  }
  options.native = given.native == "on"    ? vm::Native::On
                   : given.native == "off" ? vm::Native::Off
                                           : vm::Native::Auto;
  options.client = given.disconnected ? run::Client::Absent : run::Client::Connected;
  if (given.lenient)
    options.ranges = spec::Ranges::Lenient;
  options.target = given.target.target();
  options.target.version =
      std::min(options.target.version, spec::info(options.firmware).language());
  if (given.target.ram != 0)
    options.ram_bytes = static_cast<std::size_t>(given.target.ram);
  constexpr Duration frame = 20ms;
  if (given.realtime)
    options.slice = frame;
  options.asks = given.input == from_stdin ? run::Asks::Yes : run::Asks::No;
  auto stimuli = read_stimuli(context, given.stimuli);
  if (!stimuli)
    return tl::unexpected(stimuli.error());
  options.stimuli = *std::move(stimuli);
  return options;
}

} // namespace orb::cli
