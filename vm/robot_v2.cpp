#include "vm/robot_v2.h"

#include "protocol/packet.h"
#include "protocol/payload_v2.h"
#include "spec/ble.h"
#include "vm/body/angles.h"
#include "vm/common/bluetooth.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace orb::vm {
namespace {

using protocol::PacketV2;
using spec::V2Command;
using spec::V2Error;
using spec::V2Flag;
using spec::V2Processor;

constexpr double cm_per_m = 100;   // streams use metres
constexpr double hundredths = 100; // of a volt
/// A client listens for a message only after it has read the answer.
constexpr Duration after_answer = 8ms;
/// Range of the gyroscope, in degrees per second. [?]
constexpr double gyro_end = 2000;
constexpr double encoder_steps_per_cm = 40; // [?]

Color color_at(ByteView data, std::size_t at) {
  return {data[at], data[at + 1], data[at + 2]};
}

void append_text(Bytes& out, std::string_view text) {
  const auto bytes = as_bytes(text);
  out.insert(out.end(), bytes.begin(), bytes.end());
  out.push_back(0);
}

} // namespace

RobotV2::RobotV2(Ball& ball, spec::Robot robot, std::string address)
    : ball_(&ball), robot_(spec::info(robot)), address_(std::move(address)) {}

RobotV2::RobotV2(const RobotV2& other, Ball& ball) : RobotV2(other) {
  ball_ = &ball;
}

void RobotV2::connect() {
  decoder_ = {};
  out_.clear();
}

void RobotV2::disconnect() {
  hangs_up_at_ = never;
  stop_streams();
  out_.clear();
  soon_.clear();
  wishes_ = {};
}

std::optional<Bytes> RobotV2::take_packet() {
  if (out_.empty())
    return std::nullopt;
  auto packet = std::move(out_.front());
  out_.pop_front();
  return packet;
}

void RobotV2::stay_awake() {
  said_will_sleep_ = false;
  const bool is_rvr = robot_.sensors == spec::RobotSensors::Services;
  sleeps_at_ = awake_ && is_rvr ? ball_->now() + spec::v2_sleeps_after : never;
}

void RobotV2::receive(ByteView bytes) {
  decoder_.feed(bytes);
  while (const auto item = decoder_.next())
    if (item->kind == protocol::ItemV2::Kind::Packet &&
        !spec::has(item->packet.flags, V2Flag::Response))
      obey(item->packet);
}

void RobotV2::obey(const PacketV2& request) {
  Bytes answer;
  const auto error = perform(request, answer);
  if (spec::has(request.flags, V2Flag::Activity))
    stay_awake();
  const bool only_errors = spec::has(request.flags, V2Flag::OnlyErrorResponse);
  if (!spec::has(request.flags, V2Flag::RequestResponse) ||
      (only_errors && error == V2Error::Success))
    return;
  PacketV2 response;
  response.flags = static_cast<std::uint8_t>(static_cast<int>(V2Flag::Response) |
                                             (request.flags & static_cast<int>(V2Flag::Activity)));
  if (spec::has(request.flags, V2Flag::HasSource)) {
    response.flags |= static_cast<std::uint8_t>(V2Flag::HasTarget);
    response.target = request.source;
  }
  if (spec::has(request.flags, V2Flag::HasTarget)) {
    response.flags |= static_cast<std::uint8_t>(V2Flag::HasSource);
    response.source = request.target;
  }
  response.did = request.did;
  response.cid = request.cid;
  response.seq = request.seq;
  response.error = static_cast<std::uint8_t>(error);
  if (error == V2Error::Success)
    response.data = std::move(answer);
  out_.push_back(encode(response));
}

V2Error RobotV2::perform(const PacketV2& request, Bytes& answer) {
  if (const auto error = protocol::refusal(request, robot_); error != V2Error::Success)
    return error;
  const auto* row = spec::find_v2_command(request.did, request.cid);
  if (!awake_ && !protocol::serves_asleep(request.did))
    return V2Error::TargetUnavailable;
  return perform(row->command, request, answer);
}

V2Error RobotV2::perform(V2Command command, const PacketV2& request, Bytes& answer) {
  const auto data = ByteView(request.data);
  const auto& body = ball_->body();
  const auto version = [&](unsigned major, unsigned minor, unsigned revision) {
    for (const auto part : {major, minor, revision})
      append_u16(answer, part);
    return V2Error::Success;
  };
  switch (command) {
  case V2Command::Ping: answer = request.data; break;
  case V2Command::GetApiVersion: answer = {1, 3}; break;
  case V2Command::Shell: return V2Error::NotImplemented;
  case V2Command::GetDeviceIds:
    for (const auto& row : spec::v2_commands)
      if (spec::knows(robot_, row) && (answer.empty() || answer.back() != row.did()))
        answer.push_back(row.did());
    break;
  case V2Command::GetCommandIds:
    for (const auto& row : spec::v2_commands)
      if (spec::knows(robot_, row) && row.did() == data[0])
        answer.push_back(row.cid());
    break;
  case V2Command::GetMainVersion: return version(5, 1, 0);
  case V2Command::GetBootVersion: return version(4, 1, 0);
  case V2Command::GetBoardRevision: answer = {1}; break;
  case V2Command::GetMac: append_text(answer, address_); break;
  case V2Command::GetModel: append_text(answer, robot_.title); break;
  case V2Command::GetStatsId: answer = {0, 0}; break;
  case V2Command::GetSecondVersion: {
    Bytes parts;
    for (const unsigned part : {5U, 1U, 0U})
      append_u16(parts, part);
    say_soon(spec::V2Message::SecondVersion, V2Processor::Secondary, std::move(parts));
    break;
  }
  case V2Command::GetProcessorName:
    append_text(answer,
                request.target == spec::v2_target(V2Processor::Secondary) ? "ST" : "Nordic");
    break;
  case V2Command::DeepSleep:
  case V2Command::Sleep: fall_asleep(); break;
  case V2Command::GetVoltage:
    append_u16(answer, static_cast<std::uint32_t>(std::lround(body.battery_v() * hundredths)));
    break;
  case V2Command::GetBatteryState: answer = {std::uint8_t(body.charging() ? 1 : 2)}; break;
  case V2Command::BatteryNotify: wishes_.battery = data[0] != 0; break;
  case V2Command::Wake:
    hangs_up_at_ = never;
    if (!std::exchange(awake_, true)) {
      if (has_slept_) // after power-on it can move at once
        moves_from_ = ball_->now() + spec::wakes_in(robot_.robot);
      reset_locator(); // clients expect the locator to follow a new yaw zero, whatever its flags
      say_soon(spec::V2Message::Woke, V2Processor::Primary, {});
    }
    break;
  case V2Command::GetPercent:
    answer = {
        static_cast<std::uint8_t>(spec::charge(spec::battery(robot_.robot), body.battery_v()))};
    break;
  case V2Command::GetVoltageState: answer = {voltage_state()}; break;
  case V2Command::VoltageNotify: wishes_.voltage = data[0] != 0; break;
  case V2Command::GetChargerState: answer = {charger_state()}; break;
  case V2Command::ChargerNotify: wishes_.charger = data[0] != 0; break;
  case V2Command::GetVolts: protocol::append_f32(answer, body.battery_v()); break;
  case V2Command::GetVoltThresholds: {
    constexpr double hysteresis = 0.1; // [?]
    const auto battery = spec::battery(robot_.robot);
    for (const double volts : {battery.critical, battery.low, hysteresis})
      protocol::append_f32(answer, volts);
    break;
  }
  case V2Command::ScreenMode:
  case V2Command::ScreenText:
  case V2Command::ScreenFace:
  case V2Command::ScreenRotation:
  case V2Command::ScreenPicture: break; // it has no screen
  case V2Command::ScreenColor:
    ball_->set_led(color_at(data, 0));
    matrix_.fill(color_at(data, 0));
    break;
  case V2Command::ScreenClear:
    ball_->set_led({});
    matrix_.clear();
    break;
  case V2Command::RawMotors: return set_motors(data);
  case V2Command::ResetYaw: ball_->drive(SetHeading{0}); break;
  case V2Command::DriveWithHeading: drive(data); break;
  case V2Command::SetStabilization:
  case V2Command::Stabilize:
    ball_->drive(data[0] == 0 ? Stabilization::Off : Stabilization::On);
    break;
  case V2Command::PlayAnimation:
  case V2Command::StopAnimation: break; // built-in animations are not modelled
  case V2Command::LegAction:
    if (is_awake_enough() && data[0] != 0) {
      constexpr std::uint8_t three_legs = 1;
      legs_ = data[0];
      leg_ = legs_ == three_legs ? 1.0 : 0.0; // out or in [?]
    }
    break;
  case V2Command::SetLegPosition:
    if (is_awake_enough())
      leg_ = protocol::read_f32(data, 0);
    break;
  case V2Command::GetLegPosition: protocol::append_f32(answer, leg_); break;
  case V2Command::GetLegAction: answer = {legs_}; break;
  case V2Command::SetHead: head_deg_ = protocol::read_f32(data, 0); break;
  case V2Command::GetHead: protocol::append_f32(answer, head_deg_); break;
  case V2Command::StreamMask:
    interval_ = std::chrono::milliseconds{read_u16(data, 0)};
    left_ = data[2];
    mask_ = read_u32(data, 3);
    start_mask();
    break;
  case V2Command::GetStreamMask:
    append_u16(answer, static_cast<std::uint32_t>(interval_ / 1ms));
    answer.push_back(static_cast<std::uint8_t>(left_));
    append_u32(answer, mask_);
    break;
  case V2Command::StreamExtended:
    extended_ = read_u32(data, 0);
    // A running stream continues: programs for a Mini request the extended sensors right after the
    // others, and get the first sample with that answer (sphero_mini's example, and its issue 2).
    if (next_sample_ == never || (mask_ == 0 && extended_ == 0))
      start_mask();
    break;
  case V2Command::GetStreamExtended: append_u32(answer, extended_); break;
  case V2Command::GyroMaxNotify: wishes_.gyro_max = data[0] != 0; break;
  case V2Command::CollisionDetection: return set_collisions(data);
  case V2Command::CollisionNotify: wishes_.collisions = data[0] != 0; break;
  case V2Command::CollisionSense: {
    // A sensitivity level becomes a threshold for both axes. [?]
    constexpr int step = 20;
    const auto threshold = static_cast<std::uint8_t>((data[1] + 1) * step);
    const auto dead_time = static_cast<std::uint8_t>(std::min(read_u16(data, 2) / 10, UINT8_MAX));
    return set_collisions(Bytes{1, threshold, 0, threshold, 0, dead_time});
  }
  case V2Command::CollisionSenseNotify: wishes_.sensed_collisions = data[0] != 0; break;
  case V2Command::ResetLocator: reset_locator(); break;
  case V2Command::LocatorFlags: break; // sources disagree on the meaning of 1
  case V2Command::GetLight: protocol::append_f32(answer, sense(spec::V2Sensor::Light)); break;
  case V2Command::CalibrateNorth: {
    // North is the direction it faced in its world at power-on.
    Bytes degrees;
    append_u16(degrees, static_cast<std::uint32_t>(
                            std::lround(wrap_360(body.yaw_deg() - body.world_pose().heading_deg)) %
                            spec::ball::full_circle));
    say_soon(spec::V2Message::North, V2Processor::Secondary, std::move(degrees));
    break;
  }
  case V2Command::GetInfrared: append_u32(answer, 0); break; // no other robot is near
  case V2Command::StartBroadcast:
  case V2Command::StartFollow:
  case V2Command::StopBroadcast:
  case V2Command::StopFollow:
  case V2Command::StartEvade:
  case V2Command::StopEvade:
  case V2Command::InfraredNotify:
  case V2Command::SendInfrared:
  case V2Command::ColorDetection: break;
  case V2Command::StreamConfigure: return configure(request);
  case V2Command::StreamStart: {
    auto& stream = services_of(request);
    const Duration period = std::chrono::milliseconds{read_u16(data, 0)};
    if (stream.tokens.empty())
      return V2Error::Failed;
    if (period == Duration{})
      return V2Error::BadParameter;
    stream.period = period;
    stream.next = ball_->now() + stream.period;
    break;
  }
  case V2Command::StreamStop: services_of(request).next = never; break;
  case V2Command::StreamClear: services_of(request) = {}; break;
  case V2Command::SetName: name_ = as_text(data).substr(0, as_text(data).find('\0')); break;
  case V2Command::GetName:
  case V2Command::GetAdvertisedName: append_text(answer, name()); break;
  case V2Command::PlaySound:
  case V2Command::StopSounds: break; // sounds are not modelled
  case V2Command::SetVolume: volume_ = data[0]; break;
  case V2Command::GetVolume: answer = {volume_}; break;
  case V2Command::SetLeds: return set_lamps(read_u16(data, 0), data.subspan(2));
  case V2Command::SetLedsLong: return set_lamps(read_u32(data, 0), data.subspan(4));
  case V2Command::SetLedsShort: return set_lamps(data[0], data.subspan(1));
  case V2Command::MatrixPixel: matrix_.pixel(data[0], data[1], color_at(data, 2)); break;
  case V2Command::MatrixFrame:
    matrix_.clear();
    for (std::size_t at = 0; at + 3 <= data.size(); at += 3)
      matrix_.pixel(static_cast<int>(at / 3) % Matrix::side,
                    static_cast<int>(at / 3) / Matrix::side, color_at(data, at));
    break;
  case V2Command::MatrixColor:
    ball_->set_led(color_at(data, 0));
    matrix_.fill(color_at(data, 0));
    break;
  case V2Command::MatrixSaveFrame: matrix_.save_frame(read_u16(data, 0), data.subspan(2)); break;
  case V2Command::MatrixSaveAnimation: return save_animation(data);
  case V2Command::MatrixPlay:
  case V2Command::MatrixPlayLoop: {
    plays_ = data[0];
    const bool loops = command == V2Command::MatrixPlayLoop && data[1] != 0;
    if (!matrix_.play(data[0], loops, ball_->now()))
      return V2Error::Failed;
    if (!matrix_.plays()) // a single picture
      say_soon(spec::V2Message::MatrixAnimationOver, V2Processor::Secondary, {data[0]});
    return V2Error::Success;
  }
  case V2Command::MatrixShowFrame:
    return matrix_.show_frame(read_u16(data, 0)) ? V2Error::Success : V2Error::Failed;
  case V2Command::MatrixFrames:
    for (const int frame : matrix_.frames())
      append_u16(answer, static_cast<std::uint32_t>(frame));
    break;
  case V2Command::MatrixForget: matrix_.forget(); break;
  case V2Command::MatrixPause: matrix_.pause(ball_->now()); break;
  case V2Command::MatrixResume: matrix_.resume(ball_->now()); break;
  case V2Command::MatrixReset: matrix_.clear(); break;
  case V2Command::MatrixOverride: break; // animations keep their own speed and fading
  case V2Command::MatrixRotation: matrix_.rotate(data[0]); break;
  case V2Command::MatrixText: {
    plays_.reset();
    const auto text = as_text(data.subspan(5));
    matrix_.scroll(color_at(data, 0), data[3], data[4] != 0,
                   std::string(text.substr(0, text.find('\0'))), ball_->now());
    break;
  }
  case V2Command::MatrixLine:
    matrix_.line(data[0], data[1], data[2], data[3], color_at(data, 4));
    break;
  case V2Command::MatrixFill:
    matrix_.rectangle(data[0], data[1], data[2], data[3], color_at(data, 4));
    break;
  case V2Command::MatrixCharacter:
    matrix_.character(color_at(data, 0), static_cast<char>(data[3]));
    break;
  case V2Command::ReleaseLeds: ball_->set_led({}); break;
  case V2Command::None: return V2Error::BadCommand;
  }
  return V2Error::Success;
}

// Requests.

/// Sends the ball a v1 command without asking for an answer.
void RobotV2::ask_ball(spec::ApiCommand command, Bytes data) {
  auto packet = protocol::make_command(command, data, 0);
  packet.flags = static_cast<std::uint8_t>(packet.flags & ~spec::sop2_answer);
  ball_->receive(encode(packet));
  ball_->advance_to(ball_->now());
}

void RobotV2::reset_locator() {
  constexpr std::size_t operands = 7; // flags 0: +y is heading 0
  ask_ball(spec::ApiCommand::ConfigureLocator, Bytes(operands, 0));
}

/// The operands have the order of API v1: each threshold is followed by its increase at full speed.
V2Error RobotV2::set_collisions(ByteView data) {
  ask_ball(spec::ApiCommand::ConfigureCollisionDetection, {data.begin(), data.end()});
  return V2Error::Success;
}

/// The data is palette, number of frames, frames.
V2Error RobotV2::save_animation(ByteView data) {
  constexpr std::size_t palette_at = 4;
  const std::size_t count_at = palette_at + std::size_t{3} * data[3];
  if (data.size() < count_at + 2)
    return V2Error::BadLength;
  const std::size_t count = read_u16(data, count_at);
  if (data.size() != count_at + 2 + 2 * count)
    return V2Error::BadLength;
  std::vector<Color> palette;
  for (auto at = palette_at; at < count_at; at += 3)
    palette.push_back(color_at(data, at));
  std::vector<int> frames;
  for (std::size_t frame = 0; frame < count; ++frame)
    frames.push_back(static_cast<int>(read_u16(data, count_at + 2 + 2 * frame)));
  matrix_.save_animation(data[0], data[1], data[2] != 0, std::move(palette), std::move(frames));
  return V2Error::Success;
}

/// Reports the end of what the matrix plays, and a changed picture.
void RobotV2::watch_matrix() {
  const bool played = matrix_.plays();
  matrix_.advance(ball_->now());
  if (played && !matrix_.plays())
    say(plays_ ? spec::V2Message::MatrixAnimationOver : spec::V2Message::TextOver,
        V2Processor::Secondary, {plays_.value_or(0)});
  if (std::exchange(shown_, matrix_.pixels()) != matrix_.pixels())
    ball_->show_matrix(matrix_.pixels());
}

std::uint8_t RobotV2::voltage_state() const {
  const auto battery = spec::battery(robot_.robot);
  const double volts = ball_->body().battery_v();
  return volts <= battery.critical ? 3 : volts <= battery.low ? 2 : 1;
}

std::uint8_t RobotV2::charger_state() const {
  if (!ball_->body().charging())
    return 1;
  return ball_->body().battery_v() < spec::battery(robot_.robot).charged ? 2 : 3;
}

/// The name it advertises, for example `SB-1A2B`.
std::string RobotV2::name() const {
  if (!name_.empty())
    return name_;
  return advertised_name(robot_.ble, address_);
}

void RobotV2::drive(ByteView data) {
  if (!is_awake_enough())
    return;
  const int speed = spec::speed_from_wire(robot_, data[0]);
  const int flags = data[3];
  const auto way = (flags & spec::v2_drive_backward) != 0 ? Way::Back : Way::Ahead;
  const auto go = speed == 0                                ? Go::Brake
                  : (flags & spec::v2_drive_fast_turn) != 0 ? Go::FastTurn
                                                            : Go::Drive;
  if (robot_.sensors == spec::RobotSensors::Services) // only this ends their raw motors
    ball_->drive(Stabilization::On);
  ball_->drive(Roll{read_u16(data, 1) % spec::ball::full_circle, speed, go, way});
  if (speed != 0)
    drives_until_ = ball_->now() + spec::v2_drive_timeout;
  else if (ball_->body().stabilized()) // raw motors continue until their own time-out
    drives_until_ = never;
}

V2Error RobotV2::set_motors(ByteView data) {
  if (!is_awake_enough())
    return V2Error::Success;
  const auto motor = [&](std::size_t at) {
    constexpr MotorMode modes[] = {MotorMode::Off, MotorMode::Forward, MotorMode::Reverse};
    return Motor{modes[data[at]], data[at + 1]};
  };
  ball_->drive(Motors{motor(0), motor(2)});
  const bool off = data[0] == 0 && data[2] == 0;
  drives_until_ = off ? never : ball_->now() + spec::v2_drive_timeout;
  return V2Error::Success;
}

V2Error RobotV2::set_lamps(std::uint32_t mask, ByteView values) {
  if (values.size() != static_cast<std::size_t>(std::popcount(mask)))
    return V2Error::BadLength;
  std::size_t at = 0;
  for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp)
    if ((mask >> lamp & 1U) != 0)
      lamps_[lamp] = values[at++];
  if ((mask & robot_.body) != 0) {
    const auto red = static_cast<std::size_t>(std::countr_zero(robot_.body));
    ball_->set_led({lamps_[red], lamps_[red + 1], lamps_[red + 2]});
  }
  if (robot_.aiming != 0 && (mask & robot_.aiming) != 0)
    ask_ball(spec::ApiCommand::SetBackLed,
             {lamps_[static_cast<std::size_t>(std::bit_width(robot_.aiming)) - 1]});
  return V2Error::Success;
}

void RobotV2::fall_asleep() {
  ball_->drive(Stop{});
  drives_until_ = never;
  stop_streams();
  ball_->set_led({});
  matrix_.clear();
  awake_ = false;
  has_slept_ = true;
  sleeps_at_ = never;
  hangs_up_at_ = ball_->now() + std::chrono::seconds{spec::ble_lingers_s};
  say_soon(spec::V2Message::DidSleep, V2Processor::Primary, {});
}

// Streams.

void RobotV2::stop_streams() {
  next_sample_ = first_.next = second_.next = never;
}

void RobotV2::start_mask() {
  const bool streams = interval_ > Duration{} && (mask_ != 0 || extended_ != 0);
  next_sample_ = streams ? ball_->now() + interval_ : never;
}

RobotV2::Services& RobotV2::services_of(const PacketV2& request) {
  const bool second = spec::has(request.flags, V2Flag::HasTarget) &&
                      request.target == spec::v2_target(V2Processor::Secondary);
  return second ? second_ : first_;
}

V2Error RobotV2::configure(const PacketV2& request) {
  constexpr std::size_t entry = 3; // id and size
  constexpr int largest = 2;
  constexpr int bits[] = {8, 16, 32};
  const auto list = ByteView(request.data).subspan(1);
  if (list.empty() || list.size() % entry != 0)
    return V2Error::BadLength;
  auto& stream = services_of(request);
  const auto processor = &stream == &second_ ? V2Processor::Secondary : V2Processor::Primary;
  std::vector<Service> services;
  for (std::size_t at = 0; at < list.size(); at += entry) {
    const auto* row = spec::find_v2_service(read_u16(list, at));
    if (row == nullptr || list[at + 2] > largest ||
        (row->processor != processor && row->processor != V2Processor::Any))
      return V2Error::BadParameter;
    services.push_back({row, bits[list[at + 2]]});
  }
  stream.tokens[request.data[0]] = std::move(services);
  return V2Error::Success;
}

double RobotV2::sense(spec::V2Sensor sensor) const {
  using spec::V2Sensor;
  const auto& body = ball_->body();
  switch (sensor) {
  case V2Sensor::QuaternionX: return body.attitude().x;
  case V2Sensor::QuaternionY: return body.attitude().y;
  case V2Sensor::QuaternionZ: return body.attitude().z;
  case V2Sensor::QuaternionW: return body.attitude().w;
  case V2Sensor::Pitch: return body.pitch_deg();
  case V2Sensor::Roll: return body.roll_deg();
  case V2Sensor::Yaw: return shortest_turn(0, body.yaw_deg());
  case V2Sensor::AccelX: return body.acceleration_g().x;
  case V2Sensor::AccelY: return body.acceleration_g().y;
  case V2Sensor::AccelZ: return body.acceleration_g().z;
  case V2Sensor::AccelOne: return body.acceleration_total_g();
  case V2Sensor::LocatorX: return body.locator_cm().x / cm_per_m;
  case V2Sensor::LocatorY: return body.locator_cm().y / cm_per_m;
  case V2Sensor::VelocityX: return body.velocity_cm_s().x / cm_per_m;
  case V2Sensor::VelocityY: return body.velocity_cm_s().y / cm_per_m;
  case V2Sensor::Speed:
    return vm::length(body.velocity_cm_s().x, body.velocity_cm_s().y) / cm_per_m;
  case V2Sensor::CoreTime:
    return std::chrono::duration<double>(ball_->now().time_since_epoch()).count();
  case V2Sensor::Head: return head_deg_;
  case V2Sensor::GyroX: return body.rotation_deg_s().x;
  case V2Sensor::GyroY: return body.rotation_deg_s().y;
  case V2Sensor::GyroZ: return body.rotation_deg_s().z;
  case V2Sensor::Light: return spec::ball::room_light;
  }
  return 0;
}

std::vector<double> RobotV2::sense(spec::V2Service service) const {
  using spec::V2Sensor;
  using spec::V2Service;
  const auto of = [&](auto... sensors) { return std::vector<double>{sense(sensors)...}; };
  switch (service) {
  case V2Service::Quaternion:
    return of(V2Sensor::QuaternionW, V2Sensor::QuaternionX, V2Sensor::QuaternionY,
              V2Sensor::QuaternionZ);
  case V2Service::Attitude: return of(V2Sensor::Pitch, V2Sensor::Roll, V2Sensor::Yaw);
  case V2Service::Accel: return of(V2Sensor::AccelX, V2Sensor::AccelY, V2Sensor::AccelZ);
  case V2Service::Gyro: return of(V2Sensor::GyroX, V2Sensor::GyroY, V2Sensor::GyroZ);
  case V2Service::Locator: return of(V2Sensor::LocatorX, V2Sensor::LocatorY);
  case V2Service::Velocity: return of(V2Sensor::VelocityX, V2Sensor::VelocityY);
  case V2Service::Speed: return of(V2Sensor::Speed);
  case V2Service::Light: return of(V2Sensor::Light);
  case V2Service::CoreTime: {
    const auto ticks = static_cast<std::uint64_t>(ball_->now().time_since_epoch() / 1ms);
    return {static_cast<double>(ticks >> 32U), static_cast<double>(ticks & UINT32_MAX)};
  }
  case V2Service::Encoders: {
    const double steps = std::floor(ball_->body().way_cm() * encoder_steps_per_cm);
    return {steps, steps};
  }
  case V2Service::Color: break;
  }
  return std::vector<double>(spec::find_v2_service(static_cast<std::uint16_t>(service))->values);
}

Bytes RobotV2::message(spec::V2Message message, V2Processor processor, Bytes data) const {
  PacketV2 packet;
  packet.flags = static_cast<std::uint8_t>(V2Flag::Activity);
  if (robot_.targets == spec::Targets::Both) {
    packet.flags |= static_cast<std::uint8_t>(V2Flag::HasTarget);
    packet.flags |= static_cast<std::uint8_t>(V2Flag::HasSource);
    packet.target = spec::v2_client;
    packet.source = spec::v2_target(processor);
  }
  packet.did = static_cast<std::uint8_t>(static_cast<int>(message) >> 8);
  packet.cid = static_cast<std::uint8_t>(message);
  packet.seq = spec::v2_message_seq;
  packet.data = std::move(data);
  return encode(packet);
}

void RobotV2::say(spec::V2Message which, V2Processor processor, Bytes data) {
  out_.push_back(message(which, processor, std::move(data)));
}

/// Queues a message that follows the answer after a short delay.
void RobotV2::say_soon(spec::V2Message which, V2Processor processor, Bytes data) {
  soon_.emplace_back(ball_->now() + after_answer, message(which, processor, std::move(data)));
}

/// Sends a float for each bit of the masks, the highest first, known or not.
void RobotV2::say_sample() {
  Bytes data;
  for (const auto mask : {spec::V2Mask::Base, spec::V2Mask::Extended})
    for (std::uint32_t bit = 1U << 31; bit != 0; bit >>= 1) {
      if (((mask == spec::V2Mask::Base ? mask_ : extended_) & bit) == 0)
        continue;
      const auto* row = spec::find_v2_sensor(mask, bit);
      protocol::append_f32(data, row == nullptr ? 0 : sense(row->sensor));
    }
  say(spec::V2Message::Sample, V2Processor::Secondary, std::move(data));
  next_sample_ += interval_;
  if (left_ > 0 && --left_ == 0)
    next_sample_ = never;
}

void RobotV2::say_services(Services& stream, V2Processor processor) {
  for (const auto& [token, services] : stream.tokens) {
    Bytes data{token};
    for (const auto& [row, bits] : services) {
      const auto values = sense(row->service);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double most = row->most(i);
        const double least = row->least(i);
        const double whole = std::exp2(bits) - 1;
        const double part = (std::clamp(values[i], least, most) - least) / (most - least);
        const auto number = static_cast<std::uint32_t>(std::llround(part * whole));
        for (int shift = bits - 8; shift >= 0; shift -= 8)
          data.push_back(static_cast<std::uint8_t>(number >> shift));
      }
    }
    say(spec::V2Message::ServiceSample, processor, std::move(data));
  }
  stream.next += stream.period;
}

/// Translates messages of the ball's own packets. Only collisions have a counterpart.
void RobotV2::hear_ball() {
  from_ball_.feed(ball_->take_output());
  while (const auto item = from_ball_.next()) {
    if (item->kind != protocol::Item::Kind::Async ||
        item->code != static_cast<std::uint8_t>(spec::AsyncId::Collision))
      continue;
    if (wishes_.sensed_collisions)
      say(spec::V2Message::CollisionSensed, V2Processor::Secondary,
          {item->data.end() - 1, item->data.end()});
    else if (wishes_.collisions) {
      // x, y, z, axis and two powers are the same; then come a third power and the low half of the
      // time.
      constexpr std::ptrdiff_t same = 11;
      constexpr std::ptrdiff_t time_at = 14;
      Bytes data(item->data.begin(), item->data.begin() + same);
      append_u16(data, 0);
      data.push_back(item->data[same]);
      data.insert(data.end(), item->data.begin() + time_at, item->data.end());
      say(spec::V2Message::Collision, V2Processor::Secondary, std::move(data));
    }
  }
}

/// Reports changes to clients that subscribed.
void RobotV2::watch_charger() {
  const bool charging = ball_->body().charging();
  if (std::exchange(was_charging_, charging) != charging) {
    if (wishes_.charger)
      say(spec::V2Message::ChargerState, V2Processor::Primary, {charger_state()});
    if (wishes_.battery)
      say(spec::V2Message::BatteryState, V2Processor::Primary, {std::uint8_t(charging ? 1 : 2)});
  }
  const auto state = voltage_state();
  const auto before = std::exchange(was_voltage_state_, state);
  if (wishes_.voltage && before != 0 && before != state)
    say(spec::V2Message::VoltageState, V2Processor::Primary, {state});
}

void RobotV2::watch_rotation() {
  const auto rate = ball_->body().rotation_deg_s();
  std::uint8_t flags = 0;
  unsigned bit = 0;
  for (const double value : {rate.x, -rate.x, rate.y, -rate.y, rate.z, -rate.z})
    flags = static_cast<std::uint8_t>(flags | (value >= gyro_end ? 1U << bit++ : (++bit, 0U)));
  if (!std::exchange(was_turning_fast_, flags != 0) && flags != 0 && wishes_.gyro_max)
    say(spec::V2Message::GyroMax, V2Processor::Secondary, {flags});
}

Instant RobotV2::next_event() const {
  return std::min({drives_until_, hangs_up_at_, next_sample_, matrix_.next_event(), first_.next,
                   second_.next, soon_.empty() ? never : soon_.front().first,
                   said_will_sleep_ || sleeps_at_ == never
                       ? sleeps_at_
                       : sleeps_at_ - Duration{spec::v2_sleep_warning}});
}

void RobotV2::run() {
  const auto now = ball_->now();
  if (hangs_up_at_ <= now) {
    disconnect();
    ball_->disconnect();
  }
  for (; !soon_.empty() && soon_.front().first <= now; soon_.pop_front())
    out_.push_back(std::move(soon_.front().second));
  if (sleeps_at_ <= now)
    fall_asleep();
  else if (!said_will_sleep_ && sleeps_at_ != never && sleeps_at_ - now <= spec::v2_sleep_warning) {
    said_will_sleep_ = true;
    say(spec::V2Message::WillSleep, V2Processor::Primary, {});
  }
  watch_charger();
  watch_rotation();
  watch_matrix();
  if (drives_until_ <= now) {
    drives_until_ = never;
    ball_->drive(Stop{});
  }
  if (next_sample_ <= now)
    say_sample();
  if (first_.next <= now)
    say_services(first_, V2Processor::Primary);
  if (second_.next <= now)
    say_services(second_, V2Processor::Secondary);
  hear_ball();
}

} // namespace orb::vm
