#include "run/tether/wire_v1.h"

#include "protocol/decoder.h"
#include "protocol/packet.h"
#include "spec/api.h"
#include "spec/ball.h"
#include "spec/unit.h"
#include "uploader/session.h"
#include "vm/body/angles.h"

#include <cmath>

namespace orb::run {
namespace {

using spec::ApiCommand;

constexpr std::uint32_t motion_timeout_flag = spec::permanent_option_flags::motion_timeout;
constexpr int default_motion_timeout_ms = 2000;

/// Returns where to store the value of a source; null if it is not streamed.
double* field_of(vm::Sample& sample, spec::StreamSource source) {
  using enum spec::StreamSource;
  const auto attitude = [&]() -> vm::Quaternion& {
    return sample.attitude ? *sample.attitude : sample.attitude.emplace();
  };
  switch (source) {
  case Pitch: return &sample.pitch_deg;
  case Roll: return &sample.roll_deg;
  case Yaw: return &sample.yaw_deg;
  case AccelX: return &sample.acceleration_g.x;
  case AccelY: return &sample.acceleration_g.y;
  case AccelZ: return &sample.acceleration_g.z;
  case GyroX: return &sample.rotation_deg_s.x;
  case GyroY: return &sample.rotation_deg_s.y;
  case GyroZ: return &sample.rotation_deg_s.z;
  case Q0: return &attitude().w;
  case Q1: return &attitude().x;
  case Q2: return &attitude().y;
  case Q3: return &attitude().z;
  case OdometerX: return &sample.place_cm.x;
  case OdometerY: return &sample.place_cm.y;
  case VelocityX: return &sample.velocity_cm_s.x;
  case VelocityY: return &sample.velocity_cm_s.y;
  case AccelXRaw:
  case AccelYRaw:
  case AccelZRaw:
  case GyroXRaw:
  case GyroYRaw:
  case GyroZRaw:
  case RightEmfRaw:
  case LeftEmfRaw:
  case LeftPwm:
  case RightPwm:
  case RightEmf:
  case LeftEmf:
  case AccelOne: break;
  }
  return nullptr;
}

bool is_streamed(spec::StreamSource source, const Streamed& streamed) {
  using enum spec::StreamSource;
  const auto is_one_of = [&](auto... all) { return ((source == all) || ...); };
  if (is_one_of(AccelX, AccelY, AccelZ))
    return streamed.acceleration;
  if (is_one_of(GyroX, GyroY, GyroZ))
    return streamed.rotation;
  if (is_one_of(Q0, Q1, Q2, Q3))
    return streamed.attitude;
  vm::Sample sample;
  return field_of(sample, source) != nullptr;
}

/// MASK and MASK2 of all streamed sources.
std::uint64_t mask_of(const Streamed& streamed) {
  std::uint64_t mask = 0;
  for (const auto& row : spec::streams)
    if (is_streamed(row.source, streamed))
      mask |= row.mask;
  return mask;
}

/// Parses a frame of the stream; nullopt if its size does not match.
std::optional<vm::Sample> read_frame(ByteView data, const Streamed& streamed, spec::Axes axes) {
  constexpr std::size_t value = 2; // bytes
  vm::Sample sample;
  std::size_t at = 0;
  for (const auto& row : spec::streams) {
    if (!is_streamed(row.source, streamed))
      continue;
    auto* const place = field_of(sample, row.source);
    if (data.size() < at + value)
      return std::nullopt;
    const auto steps = static_cast<std::int16_t>(read_u16(data, at));
    *place = spec::scale_of(row.unit).back(steps);
    at += value;
  }
  sample.place_cm = from_axes(axes, sample.place_cm);
  const auto velocity = vm::from_axes(axes, {sample.velocity_cm_s.x, sample.velocity_cm_s.y});
  sample.velocity_cm_s = {velocity.x, velocity.y};
  sample.yaw_deg = vm::wrap_360(sample.yaw_deg);
  return at == data.size() ? std::optional(sample) : std::nullopt;
}

Request request(ApiCommand command, Bytes data) {
  return {spec::did(command), spec::cid(command), std::move(data)};
}

bool is_command(const Request& request, ApiCommand command) {
  return request.did == spec::did(command) && request.cid == spec::cid(command);
}

/// A robot with packets v1. Large because RobotWire has a member for everything that is asked of a
/// robot.
class WireV1 final : public RobotWire {
public:
  WireV1(spec::Robot robot, CollisionLimits limits) : robot_(robot), limits_(limits) {}

  Bytes encode(const Request& request, std::uint8_t seq) const override {
    return protocol::encode(
        protocol::Command{request.did, request.cid, seq, spec::sop2_default, request.data});
  }
  std::uint8_t next_seq(std::uint8_t seq) const override {
    return static_cast<std::uint8_t>(seq + 1);
  }
  void feed(ByteView bytes) override { decoder_.feed(bytes); }
  std::optional<RobotMessage> next() override;

  std::vector<Request> setup(Aim aim) const override;
  void hear_setup(const Request& request, const std::optional<Bytes>& answer) override {
    if (is_command(request, ApiCommand::GetPermanentOptionFlags) && answer &&
        answer->size() == sizeof(std::uint32_t))
      flags_ = read_u32(*answer, 0);
  }
  std::vector<Request> setup_more() const override {
    return {timeout(), flags(flags_.value_or(0) | motion_timeout_flag),
            collisions(limits_.operands())};
  }
  std::vector<Request> stream(const Streamed& streamed) override;
  std::vector<Request> silence() const override;
  std::vector<Request> teardown() const override;

  std::optional<Request> drive(const vm::Motion& motion) const override;
  Request brake(int heading_deg) const override { return roll({heading_deg, 0, vm::Go::Brake}); }
  std::vector<Request> show(vm::Color color) const override {
    return {request(ApiCommand::SetRgbLed, {color.red, color.green, color.blue, 0})};
  }
  std::optional<Request> show_back(int level) const override {
    return request(ApiCommand::SetBackLed, {static_cast<std::uint8_t>(level)});
  }
  Request ask_battery() const override { return request(ApiCommand::GetPowerState, {}); }
  std::optional<vm::stimulus::Battery> read_battery(const Bytes& answer) const override {
    constexpr std::size_t voltage = 2; // offset; in 0.01 V
    if (answer.size() < voltage + 2)
      return std::nullopt;
    return vm::stimulus::Battery{read_u16(answer, voltage) / 100.0};
  }
  bool loosens(const Request& request) const override {
    return is_command(request, ApiCommand::SetRawMotorValues) ||
           (is_command(request, ApiCommand::SetStabilization) && request.data.front() == 0);
  }
  std::string_view command_name(const Request& request) const override {
    const auto* row = spec::find_command(request.did, request.cid);
    return row == nullptr ? std::string_view() : row->name;
  }
  Duration interval() const override { return spec::info(robot_).interval; }
  std::string describe(std::uint8_t error) const override { return uploader::describe_code(error); }
  bool means_later(std::uint8_t error) const override {
    return spec::retry_of(error) == spec::Retry::SameAgain || uploader::is_transient(error);
  }

private:
  static Request roll(const vm::Roll& roll) {
    Bytes data{static_cast<std::uint8_t>(roll.speed)};
    append_u16(data, static_cast<std::uint32_t>(roll.heading_deg));
    data.push_back(static_cast<std::uint8_t>(roll.go));
    return request(ApiCommand::Roll, std::move(data));
  }
  static Request flags(std::uint32_t flags) {
    Bytes data;
    append_u32(data, flags);
    return request(ApiCommand::SetPermanentOptionFlags, std::move(data));
  }
  static Request collisions(Bytes operands) {
    auto configured = request(ApiCommand::ConfigureCollisionDetection, std::move(operands));
    configured.need = Request::Need::Try;
    return configured;
  }
  static Request timeout() {
    Bytes data;
    append_u16(data, default_motion_timeout_ms);
    return request(ApiCommand::SetMotionTimeout, std::move(data));
  }

  spec::Robot robot_;
  CollisionLimits limits_;
  protocol::Decoder decoder_{protocol::Direction::FromBall};
  std::optional<std::uint32_t> flags_; ///< the robot's own
  Streamed streamed_;                  ///< what the robot streams
};

std::optional<RobotMessage> WireV1::next() {
  while (const auto item = decoder_.next()) {
    if (item->kind == protocol::Item::Kind::Response)
      return RobotMessage{
          RobotMessage::Answer{item->seq, item->code, {item->data.begin(), item->data.end()}}};
    if (item->kind != protocol::Item::Kind::Async)
      continue;
    if (item->code == static_cast<std::uint8_t>(spec::AsyncId::SensorData))
      if (const auto sample = read_frame(item->data, streamed_, spec::axes(robot_)))
        return RobotMessage{*sample};
    if (item->code == static_cast<std::uint8_t>(spec::AsyncId::Collision))
      if (const auto blow = read_collision(item->data, 11))
        return RobotMessage{*blow};
  }
  return std::nullopt;
}

std::vector<Request> WireV1::setup(Aim aim) const {
  std::vector<Request> all{request(ApiCommand::GetPermanentOptionFlags, {}),
                           request(ApiCommand::SetStabilization, {1})};
  if (aim == Aim::Zero) {
    all.push_back(request(ApiCommand::SetHeading, {0, 0}));
    constexpr std::size_t operands = 7;
    Bytes origin(operands, 0);
    all.push_back(request(ApiCommand::ConfigureLocator, std::move(origin)));
  }
  return all;
}

std::vector<Request> WireV1::stream(const Streamed& streamed) {
  streamed_ = streamed;
  constexpr unsigned samples_per_second = 33;
  Bytes stream;
  append_u16(stream, spec::ball::control_rate / samples_per_second);
  append_u16(stream, 1);
  append_u32(stream, static_cast<std::uint32_t>(mask_of(streamed)));
  stream.push_back(0);
  append_u32(stream, static_cast<std::uint32_t>(mask_of(streamed) >> 32));
  return {request(ApiCommand::SetDataStreaming, std::move(stream))};
}

std::vector<Request> WireV1::silence() const {
  Bytes nothing;
  append_u16(nothing, 1);
  append_u16(nothing, 1);
  append_u32(nothing, 0);
  nothing.push_back(0);
  append_u32(nothing, 0);
  return {request(ApiCommand::SetDataStreaming, std::move(nothing))};
}

std::vector<Request> WireV1::teardown() const {
  return {request(ApiCommand::SetStabilization, {1}),
          request(ApiCommand::SetRgbLed, {0, 0, 0, 0}),
          request(ApiCommand::SetBackLed, {0}),
          collisions(CollisionLimits::off()),
          timeout(),
          flags(flags_.value_or(0))};
}

std::optional<Request> WireV1::drive(const vm::Motion& motion) const {
  if (const auto* to = std::get_if<vm::Roll>(&motion))
    return roll(*to);
  if (const auto* motors = std::get_if<vm::Motors>(&motion))
    return request(ApiCommand::SetRawMotorValues, {static_cast<std::uint8_t>(motors->left.mode),
                                                   static_cast<std::uint8_t>(motors->left.power),
                                                   static_cast<std::uint8_t>(motors->right.mode),
                                                   static_cast<std::uint8_t>(motors->right.power)});
  if (const auto* mode = std::get_if<vm::Stabilization>(&motion))
    return request(ApiCommand::SetStabilization,
                   {std::uint8_t(*mode == vm::Stabilization::Off ? 0 : 1)});
  if (const auto* rate = std::get_if<vm::RotationRate>(&motion)) {
    using namespace spec::ball;
    const auto value = std::lround(std::min(rate->deg_per_s / rotation_unit, double{greatest}));
    return request(ApiCommand::SetRotationRate, {static_cast<std::uint8_t>(value)});
  }
  return std::nullopt;
}

} // namespace

std::unique_ptr<RobotWire> make_wire_v1(spec::Robot robot, CollisionLimits limits) {
  return std::make_unique<WireV1>(robot, limits);
}

} // namespace orb::run
