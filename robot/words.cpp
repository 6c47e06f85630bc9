#include "robot/words.h"

#include "base/render.h"
#include "base/text/suggest.h"
#include "base/text/utf8.h"
#include "spec/ble.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>
#include <vector>

namespace orb::robot {
namespace {

template <class Rows>
std::string no_such_row(std::string_view what, std::string_view name, const Rows& rows) {
  std::vector<std::string_view> names;
  for (const auto& row : rows)
    names.push_back(row.name);
  return no_such(what, name, names);
}

constexpr double farthest = 1e6; // cm, degrees: arithmetic stays exact enough

} // namespace

std::string no_such(std::string_view what, std::string_view name,
                    const std::vector<std::string_view>& names) {
  return fmt::format(
      "there is no {} `{}`; {}", what, to_printable(name),
      did_you_mean(name, names, fmt::format("write one of {}", fmt::join(names, ", "))));
}

tl::expected<Options, std::string> read_options(const Words& words) {
  Options options;
  options.name = words.name;
  options.seed = words.seed;
  for (const double number : {words.x_cm, words.y_cm, words.heading_deg})
    if (!(std::abs(number) <= farthest))
      return tl::unexpected(
          fmt::format("a robot cannot start at {}; places and headings are numbers up to {}",
                      number, farthest));
  options.start = {{words.x_cm, words.y_cm}, words.heading_deg};
  if (!words.firmware.empty()) {
    const auto* row = spec::find_firmware(words.firmware);
    if (row == nullptr)
      return tl::unexpected(no_such_row("firmware", words.firmware, spec::firmwares));
    options.firmware = row->firmware;
  }
  if (!words.fault.empty()) {
    auto plan = protocol::parse_fault_plan(words.fault);
    if (!plan)
      return tl::unexpected(plan.error());
    options.fault = *plan;
  }
  options.keep = words.keep;
  return options;
}

tl::expected<spec::Robot, std::string> read_kind(std::string_view name) {
  if (const auto* row = spec::find_robot(name))
    return row->robot;
  return tl::unexpected(no_such_row("robot", name, spec::robots));
}

tl::expected<report::Course, std::string> read_course(const std::string& drawing) {
  if (drawing.empty())
    return report::Course{};
  const Source source("course", drawing);
  auto read = report::read_course(source);
  const auto error = std::find_if(read.findings.begin(), read.findings.end(), is_error);
  if (error != read.findings.end())
    return tl::unexpected("the course cannot be used: " + to_printable(in_one_line(*error)));
  return std::move(read.course);
}

tl::expected<Duration, std::string> read_seconds(double seconds) {
  constexpr double longest = 3.15e9; // a hundred years; nanoseconds overflow beyond three hundred
  if (!(std::abs(seconds) <= longest))
    return tl::unexpected(fmt::format("{} is no time in seconds", seconds));
  constexpr double ns_per_s = 1e9;
  return Duration{std::llround(seconds * ns_per_s)};
}

Gatt gatt(spec::Robot kind) {
  const auto& ble = spec::info(spec::info(kind).ble);
  Gatt out;
  out.name_prefix = ble.prefix;
  out.protocol = ble.protocol == spec::BleProtocol::V1 ? "v1" : "v2";
  for (const auto& row : spec::ble_attributes)
    if (spec::has(ble.model, row))
      out.characteristics.push_back({row.service, row.uuid, row.summary, row.can, row.value});
  for (const auto& row : spec::ble_greeting)
    if (spec::has(ble.model, row.characteristic))
      out.greeting.push_back({spec::info(row.characteristic).uuid, row.bytes});
  out.is_deaf = spec::is_deaf(ble.model);
  out.patience = spec::patience(ble.model);
  out.commands_uuid = spec::info(spec::takes_packets(ble.protocol)).uuid;
  out.answers_uuid = spec::info(spec::sends_packets(ble.protocol)).uuid;
  const auto& advertised = spec::advertised(ble.protocol);
  if (advertised.service)
    out.advertised_service = spec::uuid_of(*advertised.service);
  out.advertised_power = advertised.power_dbm;
  out.advertised_maker = advertised.maker;
  return out;
}

std::vector<std::string_view> properties(std::uint8_t can) {
  using namespace spec::ble_can;
  constexpr std::pair<std::uint8_t, std::string_view> words[] = {
      {Read, "read"},
      {WriteSilently, "write-without-response"},
      {Write, "write"},
      {Notify, "notify"},
      {Indicate, "indicate"}};
  std::vector<std::string_view> out;
  for (const auto& [bit, word] : words)
    if ((can & bit) != 0)
      out.push_back(word);
  return out;
}

} // namespace orb::robot
