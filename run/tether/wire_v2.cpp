#include "run/tether/wire_v2.h"

#include "protocol/payload_v2.h"
#include "run/tether/wire_v1.h"
#include "vm/body/angles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace orb::run {
namespace {

using protocol::PacketV2;
using spec::V2Command;
using spec::V2Sensor;
using spec::V2Service;

constexpr double cm_per_m = 100;

constexpr V2Service useful_services[] = {V2Service::Attitude, V2Service::Accel, V2Service::Gyro,
                                         V2Service::Locator, V2Service::Velocity};
constexpr std::uint8_t token = 1;
constexpr unsigned sample_interval_ms = 50;

bool is_v2_streamed(V2Sensor sensor, const Streamed& streamed) {
  using enum V2Sensor;
  const auto is_one_of = [&](auto... all) { return ((sensor == all) || ...); };
  if (is_one_of(AccelX, AccelY, AccelZ))
    return streamed.acceleration;
  if (is_one_of(GyroX, GyroY, GyroZ))
    return streamed.rotation;
  return is_one_of(Pitch, Roll, Yaw, LocatorX, LocatorY, VelocityX, VelocityY);
}

std::uint32_t v2_mask_of(spec::V2Mask mask, const Streamed& streamed) {
  std::uint32_t bits = 0;
  for (const auto& row : spec::v2_sensors)
    if (row.mask == mask && is_v2_streamed(row.sensor, streamed))
      bits |= row.bit;
  return bits;
}

Request v2_request(V2Command command, Bytes data = {}) {
  const auto& row = spec::info(command);
  return {row.did(), row.cid(), std::move(data)};
}

bool is_v2_command(const Request& request, V2Command command) {
  const auto& row = spec::info(command);
  return request.did == row.did() && request.cid == row.cid();
}

void take(vm::Sample& sample, V2Sensor sensor, double value) {
  switch (sensor) {
  case V2Sensor::Pitch: sample.pitch_deg = value; break;
  case V2Sensor::Roll: sample.roll_deg = value; break;
  case V2Sensor::Yaw: sample.yaw_deg = vm::wrap_360(value); break;
  case V2Sensor::AccelX: sample.acceleration_g.x = value; break;
  case V2Sensor::AccelY: sample.acceleration_g.y = value; break;
  case V2Sensor::AccelZ: sample.acceleration_g.z = value; break;
  case V2Sensor::LocatorX: sample.place_cm.x = value * cm_per_m; break;
  case V2Sensor::LocatorY: sample.place_cm.y = value * cm_per_m; break;
  case V2Sensor::VelocityX: sample.velocity_cm_s.x = value * cm_per_m; break;
  case V2Sensor::VelocityY: sample.velocity_cm_s.y = value * cm_per_m; break;
  case V2Sensor::GyroX: sample.rotation_deg_s.x = value; break;
  case V2Sensor::GyroY: sample.rotation_deg_s.y = value; break;
  case V2Sensor::GyroZ: sample.rotation_deg_s.z = value; break;
  case V2Sensor::QuaternionX:
  case V2Sensor::QuaternionY:
  case V2Sensor::QuaternionZ:
  case V2Sensor::QuaternionW:
  case V2Sensor::AccelOne:
  case V2Sensor::Speed:
  case V2Sensor::CoreTime:
  case V2Sensor::Head:
  case V2Sensor::Light: break; // not requested
  }
}

/// The values of a service, as far as they are used.
std::vector<V2Sensor> values_of(V2Service service) {
  switch (service) {
  case V2Service::Attitude: return {V2Sensor::Pitch, V2Sensor::Roll, V2Sensor::Yaw};
  case V2Service::Accel: return {V2Sensor::AccelX, V2Sensor::AccelY, V2Sensor::AccelZ};
  case V2Service::Gyro: return {V2Sensor::GyroX, V2Sensor::GyroY, V2Sensor::GyroZ};
  case V2Service::Locator: return {V2Sensor::LocatorX, V2Sensor::LocatorY};
  case V2Service::Velocity: return {V2Sensor::VelocityX, V2Sensor::VelocityY};
  case V2Service::Quaternion:
  case V2Service::Color:
  case V2Service::Speed:
  case V2Service::CoreTime:
  case V2Service::Light:
  case V2Service::Encoders: break;
  }
  return {};
}

std::vector<V2Service> services_of(const Streamed& streamed) {
  std::vector<V2Service> all;
  for (const auto service : useful_services)
    if (is_v2_streamed(values_of(service).front(), streamed))
      all.push_back(service);
  return all;
}

bool is_sane(const vm::Sample& sample) {
  for (const double value :
       {sample.place_cm.x, sample.place_cm.y, sample.velocity_cm_s.x, sample.velocity_cm_s.y,
        sample.yaw_deg, sample.pitch_deg, sample.roll_deg, sample.acceleration_g.x,
        sample.acceleration_g.y, sample.acceleration_g.z, sample.rotation_deg_s.x,
        sample.rotation_deg_s.y, sample.rotation_deg_s.z}) {
    constexpr double far = 1e7;
    if (!(std::abs(value) < far))
      return false;
  }
  return true;
}

/// A robot with packets v2. Large because RobotWire has a member for everything that is asked of a
/// robot.
class WireV2 final : public RobotWire {
public:
  WireV2(spec::Robot robot, CollisionLimits limits) : robot_(spec::info(robot)), limits_(limits) {}

  Bytes encode(const Request& request, std::uint8_t seq) const override;
  std::uint8_t next_seq(std::uint8_t seq) const override {
    return seq >= spec::v2_last_seq ? 0 : static_cast<std::uint8_t>(seq + 1);
  }
  void feed(ByteView bytes) override { decoder_.feed(bytes); }
  std::optional<RobotMessage> next() override;

  void hear_setup(const Request& request, const std::optional<Bytes>& answer) override {
    senses_ = senses_ || (is_v2_command(request, V2Command::CollisionDetection) && !answer &&
                          knows(V2Command::CollisionSense));
    stabilizes_ = stabilizes_ && (!is_v2_command(request, V2Command::Stabilize) || answer);
  }
  std::vector<Request> setup_more() const override;
  std::vector<Request> setup(Aim aim) const override;
  std::vector<Request> stream(const Streamed& streamed) override;
  std::vector<Request> silence() const override;
  std::vector<Request> teardown() const override;

  std::optional<Request> drive(const vm::Motion& motion) const override;
  Request brake(int heading_deg) const override { return roll(heading_deg, 0, 0); }
  std::vector<Request> show(vm::Color color) const override;
  std::optional<Request> show_back(int level) const override;
  Duration rests_after(const Request& request) const override {
    return is_v2_command(request, V2Command::Wake) ? spec::wakes_in(robot_.robot) : Duration{};
  }
  Request ask_battery() const override {
    return knows(V2Command::GetVoltage) ? v2_request(V2Command::GetVoltage)
           : knows(V2Command::GetVolts) ? v2_request(V2Command::GetVolts, {0})
                                        : v2_request(V2Command::Ping);
  }
  std::optional<vm::stimulus::Battery> read_battery(const Bytes& answer) const override;
  bool loosens(const Request& request) const override {
    return is_v2_command(request, V2Command::RawMotors) ||
           ((is_v2_command(request, V2Command::SetStabilization) ||
             is_v2_command(request, V2Command::Stabilize)) &&
            request.data.front() == 0);
  }
  std::string_view command_name(const Request& request) const override {
    const auto* row = spec::find_v2_command(request.did, request.cid);
    return row == nullptr ? std::string_view() : row->name;
  }
  Duration interval() const override { return robot_.interval; }
  std::string describe(std::uint8_t error) const override {
    const auto* row = spec::find_v2_error(error);
    return fmt::format("{:02X}h {}", error, row == nullptr ? "(undocumented)" : row->meaning);
  }
  bool means_later(std::uint8_t error) const override {
    return error == static_cast<std::uint8_t>(spec::V2Error::Busy);
  }

private:
  static Request roll(int heading_deg, int speed, std::uint8_t flags) {
    Bytes data{static_cast<std::uint8_t>(speed)};
    append_u16(data, static_cast<std::uint32_t>(heading_deg));
    data.push_back(flags);
    return v2_request(V2Command::DriveWithHeading, std::move(data));
  }
  bool knows(V2Command command) const { return spec::knows(robot_, spec::info(command)); }
  std::optional<Request> stabilization(std::uint8_t mode) const;
  std::optional<Request> collisions(Bytes operands) const;
  Request lamps(std::uint32_t mask, const Bytes& values) const {
    return lamps_request(robot_, mask, values);
  }
  std::optional<vm::Sample> sample(const Bytes& data) const;
  std::optional<vm::Sample> services(const Bytes& data) const;

  const spec::RobotInfo& robot_;
  CollisionLimits limits_;
  bool senses_ = false;    ///< detects collisions as a BOLT+ does
  bool stabilizes_ = true; ///< stabilizes as a BOLT+ does, if the robot knows the command
  protocol::DecoderV2 decoder_;
  Streamed streamed_; ///< what the robot streams
};

Bytes WireV2::encode(const Request& request, std::uint8_t seq) const {
  PacketV2 packet;
  packet.flags = static_cast<std::uint8_t>(static_cast<int>(spec::V2Flag::RequestResponse) |
                                           static_cast<int>(spec::V2Flag::Activity));
  packet.did = request.did;
  packet.cid = request.cid;
  packet.seq = seq;
  packet.data = request.data;
  packet = protocol::address(std::move(packet), robot_);
  // Robots with services stream from their second processor.
  constexpr std::uint8_t sensors = 0x18;
  if (robot_.sensors == spec::RobotSensors::Services && request.did == sensors)
    packet.target = spec::v2_target(spec::V2Processor::Secondary);
  return protocol::encode(packet);
}

std::optional<vm::Sample> WireV2::sample(const Bytes& data) const {
  vm::Sample sample;
  std::size_t at = 0;
  for (const auto& row : spec::v2_sensors) {
    if (!is_v2_streamed(row.sensor, streamed_))
      continue;
    if (data.size() < at + sizeof(float)) {
      if (row.mask == spec::V2Mask::Extended)
        break; // the robot may have no gyroscope
      return std::nullopt;
    }
    take(sample, row.sensor, protocol::read_f32(data, at));
    at += sizeof(float);
  }
  if (at != data.size() || !is_sane(sample))
    return std::nullopt;
  return sample;
}

std::optional<vm::Sample> WireV2::services(const Bytes& data) const {
  vm::Sample sample;
  if (data.empty() || data[0] != token)
    return std::nullopt;
  std::size_t at = 1;
  for (const auto service : services_of(streamed_)) {
    const auto& row = *spec::find_v2_service(static_cast<std::uint16_t>(service));
    const auto sensors = values_of(service);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      if (data.size() < at + sizeof(std::uint32_t))
        return std::nullopt;
      constexpr double whole = 4294967295.0;
      const double part = read_u32(data, at) / whole;
      take(sample, sensors[i], row.least(i) + part * (row.most(i) - row.least(i)));
      at += sizeof(std::uint32_t);
    }
  }
  return at == data.size() ? std::optional(sample) : std::nullopt;
}

std::optional<RobotMessage> WireV2::next() {
  while (const auto item = decoder_.next()) {
    if (item->kind != protocol::ItemV2::Kind::Packet)
      continue;
    const auto& packet = item->packet;
    if (spec::has(packet.flags, spec::V2Flag::Response))
      return RobotMessage{RobotMessage::Answer{packet.seq, packet.error, packet.data}};
    if (packet.seq != spec::v2_message_seq)
      continue;
    const auto* row = spec::find_v2_message(packet.did, packet.cid);
    if (row == nullptr)
      continue;
    std::optional<vm::Sample> felt;
    if (row->message == spec::V2Message::Sample)
      felt = sample(packet.data);
    if (row->message == spec::V2Message::ServiceSample)
      felt = services(packet.data);
    if (felt)
      return RobotMessage{*felt};
    if (row->message == spec::V2Message::WillSleep)
      return RobotMessage{RobotMessage::WillSleep{}};
    if (row->message == spec::V2Message::CollisionSensed)
      return RobotMessage{vm::event::Collision{}}; // the message contains nothing else
    if (row->message == spec::V2Message::Collision)
      if (const auto blow = read_collision(packet.data, 13))
        return RobotMessage{*blow};
  }
  return std::nullopt;
}

std::optional<vm::stimulus::Battery> WireV2::read_battery(const Bytes& answer) const {
  double volts = 0;
  if (knows(V2Command::GetVoltage) && answer.size() == sizeof(std::uint16_t))
    volts = read_u16(answer, 0) / 100.0;
  else if (knows(V2Command::GetVolts) && answer.size() == sizeof(float))
    volts = protocol::read_f32(answer, 0);
  constexpr double most = 20; // more than any battery of these robots has
  return volts > 0 && volts < most ? std::optional(vm::stimulus::Battery{volts}) : std::nullopt;
}

std::vector<Request> WireV2::setup(Aim aim) const {
  std::vector<Request> all{v2_request(V2Command::Wake)};
  if (const auto on = stabilization(1))
    all.push_back(*on);
  if (knows(V2Command::LegAction))
    all.push_back(v2_request(V2Command::LegAction, {1})); // it drives on three legs
  if (aim == Aim::Zero) {
    all.push_back(v2_request(V2Command::ResetYaw));
    all.push_back(v2_request(V2Command::ResetLocator));
  }
  if (const auto detects = collisions(limits_.operands()))
    all.push_back(*detects);
  return all;
}

/// Returns nullopt for robots that always stabilize.
std::optional<Request> WireV2::stabilization(std::uint8_t mode) const {
  if (!knows(V2Command::SetStabilization))
    return std::nullopt;
  const bool knows_other = knows(V2Command::Stabilize);
  auto one = v2_request(
      knows_other && stabilizes_ ? V2Command::Stabilize : V2Command::SetStabilization, {mode});
  if (knows_other) // sources disagree on which of the two it accepts
    one.need = Request::Need::Try;
  return one;
}

std::optional<Request> WireV2::collisions(Bytes operands) const {
  if (!knows(V2Command::CollisionDetection))
    return std::nullopt;
  auto one = v2_request(V2Command::CollisionDetection, std::move(operands));
  one.need = Request::Need::Try;
  return one;
}

/// Sources disagree on how a BOLT+ detects collisions: try its own way, and do not repeat what it
/// refuses.
std::vector<Request> WireV2::setup_more() const {
  std::vector<Request> all;
  if (!stabilizes_)
    if (const auto on = stabilization(1))
      all.push_back(*on);
  constexpr std::uint8_t medium = 3;
  constexpr std::uint8_t dead_time_ms = 200;
  if (senses_) {
    all.push_back(v2_request(V2Command::CollisionSense, {0, medium, 0, dead_time_ms}));
    all.push_back(v2_request(V2Command::CollisionSenseNotify, {1}));
  }
  for (auto& one : all)
    one.need = Request::Need::Try;
  return all;
}

std::vector<Request> WireV2::stream(const Streamed& streamed) {
  streamed_ = streamed;
  if (robot_.sensors == spec::RobotSensors::Services) {
    Bytes list{token};
    for (const auto service : services_of(streamed)) {
      append_u16(list, static_cast<std::uint32_t>(service));
      list.push_back(2); // code for 32 bits
    }
    Bytes period;
    append_u16(period, sample_interval_ms);
    return {v2_request(V2Command::StreamConfigure, std::move(list)),
            v2_request(V2Command::StreamStart, std::move(period))};
  }
  Bytes extended;
  append_u32(extended, v2_mask_of(spec::V2Mask::Extended, streamed));
  Bytes mask;
  append_u16(mask, sample_interval_ms);
  mask.push_back(0);
  append_u32(mask, v2_mask_of(spec::V2Mask::Base, streamed));
  return {v2_request(V2Command::StreamExtended, std::move(extended)),
          v2_request(V2Command::StreamMask, std::move(mask))};
}

std::vector<Request> WireV2::silence() const {
  if (robot_.sensors == spec::RobotSensors::Services)
    return {v2_request(V2Command::StreamStop), v2_request(V2Command::StreamClear)};
  constexpr std::size_t operands = 7;
  return {v2_request(V2Command::StreamMask, Bytes(operands, 0)),
          v2_request(V2Command::StreamExtended, Bytes(sizeof(std::uint32_t), 0))};
}

std::vector<Request> WireV2::teardown() const {
  std::vector<Request> all;
  if (const auto on = stabilization(1))
    all.push_back(*on);
  if (senses_)
    all.push_back(v2_request(V2Command::CollisionSenseNotify, {0}));
  else if (const auto detects = collisions(CollisionLimits::off()))
    all.push_back(*detects);
  for (auto& one : show({}))
    all.push_back(std::move(one));
  if (auto back = show_back(0))
    all.push_back(*std::move(back));
  return all;
}

/// Colour lamps first, then white ones, which show the white part of the colour.
std::vector<Request> WireV2::show(vm::Color color) const {
  Bytes values;
  const auto lamp_count = std::popcount(robot_.body);
  for (int lamp = 0; lamp < lamp_count / 3; ++lamp)
    values.insert(values.end(), {color.red, color.green, color.blue});
  values.resize(static_cast<std::size_t>(lamp_count),
                std::min({color.red, color.green, color.blue}));
  std::vector<Request> all{lamps(robot_.body, std::move(values))};
  if (knows(V2Command::MatrixPixel))
    all.push_back(v2_request(V2Command::MatrixColor, {color.red, color.green, color.blue}));
  return all;
}

/// Sets the blue channel if the lamp has three.
std::optional<Request> WireV2::show_back(int level) const {
  if (robot_.aiming == 0)
    return std::nullopt;
  Bytes values(static_cast<std::size_t>(std::popcount(robot_.aiming)), 0);
  values.back() = static_cast<std::uint8_t>(level);
  return lamps(robot_.aiming, std::move(values));
}

std::optional<Request> WireV2::drive(const vm::Motion& motion) const {
  if (const auto* to = std::get_if<vm::Roll>(&motion))
    return roll(to->heading_deg, spec::speed_on_wire(robot_, to->speed),
                to->go == vm::Go::FastTurn ? spec::v2_drive_fast_turn : std::uint8_t{0});
  if (const auto* motors = std::get_if<vm::Motors>(&motion)) {
    const auto mode = [](const vm::Motor& motor) {
      return static_cast<std::uint8_t>(motor.mode == vm::MotorMode::Forward   ? 1
                                       : motor.mode == vm::MotorMode::Reverse ? 2
                                                                              : 0);
    };
    return v2_request(V2Command::RawMotors,
                      {mode(motors->left), static_cast<std::uint8_t>(motors->left.power),
                       mode(motors->right), static_cast<std::uint8_t>(motors->right.power)});
  }
  if (const auto* mode = std::get_if<vm::Stabilization>(&motion))
    return stabilization(*mode == vm::Stabilization::Off ? 0 : 1);
  return std::nullopt; // it has no rotation rate
}

} // namespace

Request lamps_request(const spec::RobotInfo& robot, std::uint32_t mask, const Bytes& values) {
  Bytes data;
  if (robot.lamps == V2Command::SetLedsShort)
    data.push_back(static_cast<std::uint8_t>(mask));
  else if (robot.lamps == V2Command::SetLedsLong)
    append_u32(data, mask);
  else
    append_u16(data, mask);
  data.insert(data.end(), values.begin(), values.end());
  return v2_request(robot.lamps, std::move(data));
}

std::unique_ptr<RobotWire> make_wire_v2(spec::Robot robot, CollisionLimits limits) {
  return std::make_unique<WireV2>(robot, limits);
}

std::unique_ptr<RobotWire> make_wire(spec::Robot robot, CollisionLimits limits) {
  return spec::info(robot).packets == spec::Packets::V2 ? make_wire_v2(robot, limits)
                                                        : make_wire_v1(robot, limits);
}

} // namespace orb::run
