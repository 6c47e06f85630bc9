#pragma once

#include "spec/ball.h"
#include "spec/ble.h"
#include "spec/carried.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// The robots, and the commands and messages of those with packets v2. Source: LIB, PKT.
namespace orb::spec {

enum class Robot : std::uint8_t {
#define ROBOT(enumerator, ...) enumerator,
#include "spec/robots.def"
};

/// A set of robots, one bit each.
using V2Robots = std::uint32_t;
constexpr V2Robots only(Robot robot) {
  return 1U << static_cast<unsigned>(robot);
}
/// The sets used by rows of commands.
namespace v2_set {
inline constexpr V2Robots Mini = only(Robot::Mini);
inline constexpr V2Robots Bolt = only(Robot::Bolt);
inline constexpr V2Robots BoltPlus = only(Robot::BoltPlus);
inline constexpr V2Robots Rvr = only(Robot::Rvr);
inline constexpr V2Robots R2 = only(Robot::R2d2) | only(Robot::R2q5);
inline constexpr V2Robots Droids = R2 | only(Robot::Bb9e);
inline constexpr V2Robots NotRvr = Mini | Bolt | BoltPlus | Droids;
inline constexpr V2Robots All = NotRvr | Rvr;
inline constexpr V2Robots TwoProcessors = Bolt | Rvr;
inline constexpr V2Robots Matrix = Bolt | BoltPlus;
inline constexpr V2Robots Infrared = Bolt | BoltPlus | Rvr;
} // namespace v2_set

enum class V2Command : std::uint16_t {
#define V2_COMMAND(enumerator, did, cid, ...) enumerator = (did) << 8 | (cid),
#include "spec/robots.def"
  None = 0xFFFF ///< no command
};

/// The processor that a command addresses, or that sent a message, in a robot with two.
enum class V2Processor : std::uint8_t { Any, Primary, Secondary };

/// The TID of a processor: port 1, node 1 or 2.
constexpr std::uint8_t v2_target(V2Processor processor) {
  return processor == V2Processor::Secondary ? 0x12 : 0x11;
}
inline constexpr std::uint8_t v2_client = 0x01;      ///< SID of a client
inline constexpr std::uint8_t v2_message_seq = 0xFF; ///< SEQ of unsolicited messages
inline constexpr std::uint8_t v2_last_seq = 0xFE;    ///< SEQ of requests counts 0 to this
/// A robot stops by itself this long after the last drive command.
inline constexpr std::chrono::milliseconds v2_drive_timeout{2000};
/// Flags of drive-with-heading. Backward it faces the heading and rolls the other way: so use it
/// the examples of the vendor's SDK for the RVR, and a program for BOLTs (purdue-arc/sphero-swarm).
/// A vendor's word on the Ollie (Sphero-Android-SDK issue 22) says the opposite. [?]
inline constexpr std::uint8_t v2_drive_backward = 1;
inline constexpr std::uint8_t v2_drive_turbo = 2;
inline constexpr std::uint8_t v2_drive_fast_turn = 4;
inline constexpr std::uint8_t v2_drive_left = 0x08;
inline constexpr std::uint8_t v2_drive_right = 0x10;
inline constexpr std::uint8_t v2_drive_drift = 0x20;
/// An RVR goes to sleep after this long without a packet that resets its time-out, and announces
/// it. [?]
inline constexpr std::chrono::seconds v2_sleeps_after{300};
inline constexpr std::chrono::seconds v2_sleep_warning{10};

enum class V2Type : std::uint8_t { U8, U16, U32, S16, F32, Text, Data };

struct V2CommandInfo {
  V2Command command;
  std::string_view name;
  V2Processor processor;
  V2Robots robots;
  std::string_view source;
  std::string_view example; ///< operands as typed in a shell
  std::string_view summary;

  std::uint8_t did() const { return static_cast<std::uint8_t>(static_cast<int>(command) >> 8); }
  std::uint8_t cid() const { return static_cast<std::uint8_t>(command); }
};

inline constexpr auto v2_commands = [] {
  using namespace v2_set;
  return std::to_array<V2CommandInfo>({
#define V2_COMMAND(enumerator, did, cid, name, processor, robots, source, example, summary)        \
  carried(V2CommandInfo{V2Command::enumerator, name, V2Processor::processor, robots, source,       \
                        example, summary}),
#include "spec/robots.def"
  });
}();

/// Finds the row of a command; null if there is none.
constexpr const V2CommandInfo* find_v2_command(std::uint8_t did, std::uint8_t cid) {
  for (const auto& row : v2_commands)
    if (static_cast<int>(row.command) == (did << 8 | cid))
      return &row;
  return nullptr;
}
/// The same by name, with hyphens or underscores.
constexpr const V2CommandInfo* find_v2_command(std::string_view name) {
  for (const auto& row : v2_commands)
    if (std::equal(row.name.begin(), row.name.end(), name.begin(), name.end(),
                   [](char a, char b) { return a == b || (a == '-' && b == '_'); }))
      return &row;
  return nullptr;
}
constexpr const V2CommandInfo& info(V2Command command) {
  for (const auto& row : v2_commands)
    if (row.command == command)
      return row;
  return v2_commands.front();
}

struct V2Field {
  V2Command command;
  V2Type type;
  std::string_view name;
  std::int64_t least = 0;
  std::int64_t most = 0; ///< for Text and Data: the most bytes
};

inline constexpr auto v2_operands = std::to_array<V2Field>({
#define V2_OPERAND(enumerator, type, name, least, most)                                            \
  {V2Command::enumerator, V2Type::type, name, least, most},
#include "spec/robots.def"
});

inline constexpr auto v2_answers = std::to_array<V2Field>({
#define V2_ANSWER(enumerator, type, name) {V2Command::enumerator, V2Type::type, name},
#include "spec/robots.def"
});

enum class V2Message : std::uint16_t {
#define V2_MESSAGE(enumerator, did, cid, ...) enumerator = (did) << 8 | (cid),
#include "spec/robots.def"
};

struct V2MessageInfo {
  V2Message message;
  std::string_view name;
  std::string_view source;
  std::string_view summary;
};

inline constexpr auto v2_messages = std::to_array<V2MessageInfo>({
#define V2_MESSAGE(enumerator, did, cid, name, source, summary)                                    \
  {V2Message::enumerator, name, source, summary},
#include "spec/robots.def"
});

struct V2Says {
  V2Message message;
  V2Type type;
  std::string_view name;
};

inline constexpr auto v2_says = std::to_array<V2Says>({
#define V2_SAYS(enumerator, type, name) {V2Message::enumerator, V2Type::type, name},
#include "spec/robots.def"
});

constexpr const V2MessageInfo* find_v2_message(std::uint8_t did, std::uint8_t cid) {
  for (const auto& row : v2_messages)
    if (static_cast<int>(row.message) == (did << 8 | cid))
      return &row;
  return nullptr;
}

enum class V2Mask : std::uint8_t { Base, Extended };

enum class V2Sensor : std::uint8_t {
#define V2_SENSOR(enumerator, ...) enumerator,
#include "spec/robots.def"
};

struct V2SensorInfo {
  V2Sensor sensor;
  std::uint32_t bit; ///< in its mask
  V2Mask mask;
  std::string_view name;
  std::string_view unit;
  std::string_view source;
};

/// In the order of their values in a sample.
inline constexpr auto v2_sensors = std::to_array<V2SensorInfo>({
#define V2_SENSOR(enumerator, bit, mask, name, unit, source)                                       \
  {V2Sensor::enumerator, 1U << (bit), V2Mask::mask, name, unit, source},
#include "spec/robots.def"
});

/// Finds the row of a bit of a mask; null if there is none.
constexpr const V2SensorInfo* find_v2_sensor(V2Mask mask, std::uint32_t bit) {
  for (const auto& row : v2_sensors)
    if (row.mask == mask && row.bit == bit)
      return &row;
  return nullptr;
}

enum class V2Service : std::uint16_t {
#define V2_SERVICE(enumerator, id, ...) enumerator = id,
#include "spec/robots.def"
};

enum class V2Sign : std::uint8_t { Signed, Unsigned };

struct V2ServiceInfo {
  V2Service service;
  V2Processor processor;
  std::string_view name;
  std::size_t values;
  double greatest;
  std::size_t which; ///< index of the value with another greatest
  double other;
  V2Sign sign;
  std::string_view source;

  double most(std::size_t value) const { return value == which ? other : greatest; }
  double least(std::size_t value) const { return sign == V2Sign::Signed ? -most(value) : 0; }
};

inline constexpr auto v2_services = std::to_array<V2ServiceInfo>({
#define V2_SERVICE(enumerator, id, processor, name, values, greatest, which, other, sign, source)  \
  {V2Service::enumerator,                                                                          \
   V2Processor::processor,                                                                         \
   name,                                                                                           \
   values,                                                                                         \
   greatest,                                                                                       \
   which,                                                                                          \
   other,                                                                                          \
   V2Sign::sign,                                                                                   \
   source},
#include "spec/robots.def"
});

constexpr const V2ServiceInfo* find_v2_service(std::uint16_t id) {
  for (const auto& row : v2_services)
    if (row.service == static_cast<V2Service>(id))
      return &row;
  return nullptr;
}

enum class Packets : std::uint8_t { V1, V2 };
enum class RobotSensors : std::uint8_t { None, Mask, Services };
/// The processors that commands may address. Any: the robot has one and accepts both.
enum class Targets : std::uint8_t { None, Any, First, Both };

struct RobotInfo {
  Robot robot;
  std::string_view name;  ///< as on the command line
  std::string_view title; ///< its name for people
  BleModel ble;
  Packets packets;
  Targets targets;
  std::chrono::milliseconds interval; ///< minimum time between commands
  RobotSensors sensors;
  V2Command lamps;
  std::uint32_t body;   ///< the lamps that RGB and LEDC set
  std::uint32_t aiming; ///< the lamps that backLED sets
  int slowest;          ///< the least speed of a drive command that moves it
  std::string_view source;
};

inline constexpr auto robots = std::to_array<RobotInfo>({
#define ROBOT(enumerator, name, title, ble, packets, targets, interval, sensors, lamps, body,      \
              aiming, slowest, source)                                                             \
  {Robot::enumerator,                                                                              \
   name,                                                                                           \
   title,                                                                                          \
   BleModel::ble,                                                                                  \
   Packets::packets,                                                                               \
   Targets::targets,                                                                               \
   std::chrono::milliseconds{interval},                                                            \
   RobotSensors::sensors,                                                                          \
   V2Command::lamps,                                                                               \
   body,                                                                                           \
   aiming,                                                                                         \
   slowest,                                                                                        \
   source},
#include "spec/robots.def"
});

constexpr const RobotInfo& info(Robot robot) {
  return robots[static_cast<std::size_t>(robot)];
}
/// Its battery voltages, with the low and critical thresholds.
constexpr Battery battery(Robot which) {
#define BATTERY(robot, full, charged, empty, low, critical, source)                                \
  if (which == Robot::robot)                                                                       \
    return {full, charged, empty, low, critical};
#include "spec/robots.def"
  return {};
}
/// How full it is, in percent.
constexpr int charge(const Battery& battery, double volts) {
  constexpr double full = 100;
  const double part = (volts - battery.empty) / (battery.charged - battery.empty);
  return static_cast<int>(std::clamp(part, 0.0, 1.0) * full + 0.5); // rounded
}
/// The axes of its locator and its velocity.
constexpr Axes axes(Robot which) {
#define AXES(robot, axes, source)                                                                  \
  if (which == Robot::robot)                                                                       \
    return Axes::axes;
#include "spec/robots.def"
  return Axes::RightAhead;
}
/// For this long after waking, the robot acknowledges drive commands but drops them.
constexpr std::chrono::milliseconds wakes_in(Robot which) {
#define WAKES(robot, ms, source)                                                                   \
  if (which == Robot::robot)                                                                       \
    return std::chrono::milliseconds{ms};
#include "spec/robots.def"
  return {};
}
/// How it drives: like the classic ball, except for its DRIVING rows.
constexpr Driving driving(Robot which) {
  Driving numbers;
#define DRIVING(robot, number, value, source)                                                      \
  if (which == Robot::robot)                                                                       \
    numbers.number = value;
#include "spec/robots.def"
  return numbers;
}
constexpr const RobotInfo* find_robot(std::string_view name) {
  for (const auto& row : robots)
    if (row.name == name)
      return &row;
  return nullptr;
}

/// The robot that advertises `name` over Bluetooth LE; nullopt if no robot that can be driven does.
constexpr std::optional<Robot> robot_called(std::string_view name) {
  const auto* known = find_ble_name(name);
  for (const auto& row : robots)
    if (known != nullptr && row.ble == known->model && row.robot != Robot::Sphero)
      return row.robot;
  return std::nullopt;
}

/// A word of programs without effect on a robot.
struct RobotLack {
  Robot robot;
  std::string_view word;
  std::string_view why;
};

inline constexpr auto robot_lacks = std::to_array<RobotLack>({
#define LACK(robot, word, why) {Robot::robot, word, why},
#include "spec/robots.def"
});

/// Finds the row of a word without effect on the robot; null if the robot supports the word.
constexpr const RobotLack* find_lack(Robot robot, std::string_view word) {
  for (const auto& row : robot_lacks)
    if (row.robot == robot && row.word == word)
      return &row;
  return nullptr;
}

/// True if the robot supports the command.
constexpr bool knows(const RobotInfo& robot, const V2CommandInfo& command) {
  return (command.robots & only(robot.robot)) != 0;
}

/// Converts a program's speed, 0 to 255, to that of a drive command, so that 1 moves the robot; and
/// back.
constexpr int speed_on_wire(const RobotInfo& robot, int speed) {
  if (robot.slowest == 0 || speed == 0)
    return speed;
  const int offset = robot.slowest * 3 / 2;
  return (speed + offset) * 2 / 3;
}
constexpr int speed_from_wire(const RobotInfo& robot, int wire) {
  if (robot.slowest == 0)
    return wire;
  constexpr int greatest = 255;
  const int offset = robot.slowest * 3 / 2;
  return std::clamp((wire * 3 + 1) / 2 - offset, 0, greatest);
}

static_assert(
    [] {
      for (std::size_t i = 1; i < v2_commands.size(); ++i)
        if (v2_commands[i - 1].command >= v2_commands[i].command)
          return false;
      return true;
    }(),
    "v2 commands are unique and ascending");

} // namespace orb::spec
