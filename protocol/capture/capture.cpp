#include "protocol/capture/capture.h"

#include "protocol/capture/carriers.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::protocol {
namespace {

/// Returns the robot whose name has this prefix.
std::optional<spec::Robot> kind_of(const std::string& name) {
  const auto* row = spec::find_ble_name(name);
  if (row == nullptr)
    return std::nullopt;
  // The classic ball does not advertise over Bluetooth LE; the last row is the robot with this
  // name.
  for (auto robot = spec::robots.rbegin(); robot != spec::robots.rend(); ++robot)
    if (robot->ble == row->model)
      return robot->robot;
  return std::nullopt;
}

void finish(Conversation& conversation, const Connections& connections, Duration first) {
  const auto name = connections.names.find(conversation.robot);
  if (name != connections.names.end())
    conversation.kind = kind_of(name->second);
  for (auto& line : conversation.lines) {
    *line.at -= first;
    line.when = fmt::format("{:.3f}", std::chrono::duration<double>(*line.at).count());
  }
}

} // namespace

std::optional<Capture> read_capture(ByteView file) {
  auto frames = read_frames(file);
  if (!frames)
    return std::nullopt;
  Capture capture{*std::move(frames), {}};
  const auto connections = read_connections(capture.frames.packets);
  // A client that knows a robot does not repeat the discovery.
  std::map<std::string, Attributes> attributes;
  for (const auto& connection : connections.all)
    learn_attributes(connection, attributes[connection.address]);
  for (const auto& connection : connections.all) {
    auto found = read_rfcomm(connection);
    if (auto gatt = read_gatt(connection, attributes[connection.address]); !gatt.lines.empty())
      found.push_back(std::move(gatt));
    for (auto& conversation : found) {
      finish(conversation, connections, capture.frames.start);
      capture.conversations.push_back(std::move(conversation));
    }
  }
  std::stable_sort(capture.conversations.begin(), capture.conversations.end(),
                   [](const Conversation& a, const Conversation& b) {
                     return a.lines.front().number < b.lines.front().number;
                   });
  return capture;
}

} // namespace orb::protocol
