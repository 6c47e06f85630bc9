#include "playground/engine/edu.h"

#include "playground/engine/reins.h"
#include "protocol/packet_v2.h"
#include "protocol/payload_v2.h"
#include "robot/words.h"
#include "run/tether/driven.h"
#include "spec/ball.h"
#include "spec/edu.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

namespace orb::playground {
namespace {

/// A client's end of a virtual robot's link, in the robot's time.
class RobotLine final : public protocol::Transport {
public:
  RobotLine(robot::Robot& robot, protocol::DecoderV2& heard) : robot_(robot), heard_(heard) {}

  Instant now() const override { return Instant{robot_.now()}; }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    if (!robot_.connected())
      return tl::unexpected(gone());
    robot_.write(bytes);
    return {};
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant deadline) override {
    for (;;) {
      auto bytes = robot_.read();
      if (!bytes.empty()) {
        heard_.feed(bytes);
        return bytes;
      }
      if (!robot_.connected())
        return tl::unexpected(gone());
      if (now() >= deadline)
        return Bytes{};
      constexpr Duration least = 100us;
      constexpr Duration most = 50ms;
      const auto next = robot_.next_event().value_or(robot_.now() + most) - robot_.now();
      robot_.advance(std::min(std::clamp(next, least, most), deadline - now()));
    }
  }

private:
  static protocol::LinkError gone() {
    return {protocol::LinkError::Kind::Closed, "the robot has hung up"};
  }

  robot::Robot& robot_;
  protocol::DecoderV2& heard_;
};

/// The time for the program's last commands to arrive.
constexpr Duration patience = 5s;

ordered_json vector(const vm::Vector3& vector) {
  return {{"x", vector.x}, {"y", vector.y}, {"z", vector.z}};
}

/// Converts to the API's yaw: -180 to 180.
double to_either_side(double angle) {
  return std::remainder(angle, double{spec::ball::full_circle});
}

ordered_json color_json(vm::Color color) {
  return {{"r", color.red}, {"g", color.green}, {"b", color.blue}};
}

} // namespace

/// A program and its robot: a virtual one, or one on the browser's link, which the virtual one then
/// shows.
struct EduRuns::Run {
  explicit Run(robot::Robot& of_floor) : robot(of_floor), line(of_floor, heard) {}

  Answer ready(const ordered_json& message);
  void begin(run::Tether& driven, const vm::Sample& first);
  void perform(const Request& request);
  tl::expected<void, Failure> pass(Instant until);
  tl::expected<void, Failure> step(Instant until);
  Answer step_on_link(const ordered_json& message, Duration until);
  Answer end_on_link(const ordered_json& message);
  void take(const ordered_json& message);
  void show(ByteView sent);
  void hear(const run::RobotMessage& said);
  void hear_sample(const vm::Sample& sample);
  void hear_packets();
  ordered_json state() const;
  Duration time() const { return tether->program_now() - origin; }
  void happens(std::string_view event) { events.push_back(ordered_json::array({event})); }
  ordered_json tell();

  robot::Robot& robot;
  protocol::DecoderV2 heard; ///< received packets v2
  RobotLine line;
  std::optional<run::Tether> own; ///< of the virtual robot
  std::optional<Reins> reins;     ///< of one on a link
  run::Tether* tether = nullptr;  ///< of the driven robot
  std::optional<EduHands> hands;
  Instant origin{};
  std::optional<Instant> give_up_at; ///< the last commands may arrive until then
  vm::Sample sample;
  double distance_cm = 0;
  std::optional<double> lux;
  std::optional<double> north;
  std::optional<Instant> light_since; ///< in free fall
  bool falls = false;
  ordered_json events = ordered_json::array();
};

void EduRuns::Run::begin(run::Tether& driven, const vm::Sample& first) {
  tether = &driven;
  hands.emplace(driven, robot.kind().robot);
  sample = first;
  origin = driven.program_now();
  const auto ask = [&](spec::V2Command command, Bytes data) {
    const auto& row = spec::info(command);
    if (spec::knows(robot.kind(), row))
      driven.send_soon({row.did(), row.cid(), std::move(data), run::Request::Need::Try});
  };
  ask(spec::V2Command::GetLight, {});
  for (const auto notice : {spec::V2Command::GyroMaxNotify, spec::V2Command::ChargerNotify,
                            spec::V2Command::InfraredNotify})
    ask(notice, {1});
}

void EduRuns::Run::perform(const Request& request) {
  if (const auto did = request.params.find("did"); did != request.params.end() && did->is_array())
    for (const auto& deed : *did)
      hands->perform(deed);
}

tl::expected<void, Failure> EduRuns::Run::pass(Instant until) {
  hands->push();
  const auto pumped = tether->pump(until, [&](const run::RobotMessage& said) { hear(said); });
  hear_packets();
  return pumped;
}

/// Runs to `until`, or until something happens.
tl::expected<void, Failure> EduRuns::Run::step(Instant until) {
  do {
    if (const auto passed = pass(until); !passed)
      return passed;
  } while (line.now() < until && events.empty());
  return {};
}

// A robot on the browser's link.

/// The virtual robot receives the same commands as the real one.
void EduRuns::Run::show(ByteView sent) {
  robot.write(sent);
  static_cast<void>(robot.read());
}

Answer EduRuns::Run::ready(const ordered_json& message) {
  const auto first = reins->ready(message);
  if (!first)
    return refuse(first.error());
  if (!*first) {
    if (const auto bytes = reins->wish().find("write"); bytes != reins->wish().end())
      show(bytes_of(*bytes));
    return print({{"wish", reins->wish()}});
  }
  robot.advance(reins->now() - Instant{robot.now()});
  robot.feel(**first);
  begin(reins->robot(), **first);
  return print(tell());
}

void EduRuns::Run::take(const ordered_json& message) {
  reins->take(message);
  robot.advance(reins->now() - Instant{robot.now()});
  if (const auto bytes = message.find("bytes"); bytes != message.end())
    heard.feed(bytes_of(*bytes));
}

Answer EduRuns::Run::step_on_link(const ordered_json& message, Duration until) {
  take(message);
  for (int i = 0; i < 2; ++i) // one pass for what arrived, and one for the program's calls
    if (const auto passed = pass(reins->now()); !passed)
      return refuse(passed.error());
  constexpr Duration shortest = 2ms;
  auto answer = reins->give(milliseconds(std::clamp(until - time(), shortest, run::longest_nap)));
  show(bytes_of(answer["write"]));
  answer.update(tell());
  return print(answer);
}

/// Stops at once, but waits for the program's last commands to arrive.
Answer EduRuns::Run::end_on_link(const ordered_json& message) {
  take(message);
  if (!give_up_at) {
    tether->obey(vm::Stop{});
    give_up_at = reins->now() + patience;
  }
  bool is_over = false;
  if (reins->winds_up())
    is_over = reins->is_wound_up([&](const run::RobotMessage& said) { hear(said); });
  else if (!pass(reins->now()) || hands->is_idle() || reins->now() > *give_up_at)
    reins->wind_up();
  constexpr double often_ms = 5;
  auto answer = reins->give(often_ms);
  show(bytes_of(answer["write"]));
  if (is_over)
    answer["stopped"] = tether->acknowledged();
  return print(answer);
}

void EduRuns::Run::hear(const run::RobotMessage& said) {
  if (const auto* felt = std::get_if<vm::Sample>(&said.what))
    hear_sample(*felt);
  else if (const auto* blow = std::get_if<vm::event::Collision>(&said.what)) {
    happens("onCollision");
    if (reins)
      robot.feel(*blow);
  }
}

/// Freefall as documented: less than 0.1 g for 0.1 s. No document says when it ends; here, when the
/// acceleration is above that again [?].
void EduRuns::Run::hear_sample(const vm::Sample& felt) {
  distance_cm +=
      std::hypot(felt.place_cm.x - sample.place_cm.x, felt.place_cm.y - sample.place_cm.y);
  sample = felt;
  if (reins)
    robot.feel(felt);
  hands->faces(static_cast<int>(std::lround(felt.yaw_deg)));
  constexpr double weightless = 0.1;
  constexpr double landed = 0.5;
  constexpr Duration long_enough = 100ms;
  const auto& a = felt.acceleration_g;
  const double weight = std::hypot(a.x, a.y, a.z);
  if (weight >= weightless)
    light_since.reset();
  else if (!light_since)
    light_since = tether->now();
  if (!falls && light_since && tether->now() - *light_since >= long_enough) {
    falls = true;
    happens("onFreefall");
  }
  if (falls && weight > landed) {
    falls = false;
    happens("onLanding");
  }
}

/// Values that the tether does not use.
void EduRuns::Run::hear_packets() {
  while (const auto item = heard.next()) {
    if (item->kind != protocol::ItemV2::Kind::Packet)
      continue;
    const auto& packet = item->packet;
    if (spec::has(packet.flags, spec::V2Flag::Response)) {
      if (spec::find_v2_command(packet.did, packet.cid) == &spec::info(spec::V2Command::GetLight) &&
          packet.data.size() == sizeof(float))
        lux = protocol::read_f32(packet.data, 0);
      continue;
    }
    const auto* row = spec::find_v2_message(packet.did, packet.cid);
    if (row == nullptr)
      continue;
    if (row->message == spec::V2Message::GyroMax)
      happens("onGyroMax");
    else if (row->message == spec::V2Message::ChargerState && packet.data.size() == 1)
      happens(packet.data[0] >= 2 ? "onCharging" : "onNotCharging");
    else if (row->message == spec::V2Message::Infrared && packet.data.size() == 1)
      events.push_back({"onIRMessage", packet.data[0]});
    else if (row->message == spec::V2Message::North && packet.data.size() == 2)
      north = static_cast<std::int16_t>(read_u16(packet.data, 0));
  }
}

ordered_json EduRuns::Run::state() const {
  constexpr double radian = std::numbers::pi / (spec::ball::full_circle / 2);
  const double pitch = sample.pitch_deg * radian;
  const double roll = sample.roll_deg * radian;
  const auto& a = sample.acceleration_g;
  // The vertical part of the acceleration, in any attitude.
  const double vertical = a.x * std::cos(pitch) * std::sin(roll) - a.y * std::sin(pitch) +
                          a.z * std::cos(pitch) * std::cos(roll);
  ordered_json state = {
      {"x", sample.place_cm.x},
      {"y", sample.place_cm.y},
      {"velocity", {{"x", sample.velocity_cm_s.x}, {"y", sample.velocity_cm_s.y}}},
      {"acceleration", vector(a)},
      {"vertical", vertical},
      {"orientation",
       {{"pitch", sample.pitch_deg},
        {"roll", sample.roll_deg},
        {"yaw", to_either_side(sample.yaw_deg - hands->aim())}}},
      {"gyroscope",
       {{"pitch", sample.rotation_deg_s.x},
        {"roll", sample.rotation_deg_s.y},
        {"yaw", sample.rotation_deg_s.z}}},
      {"distance", distance_cm}};
  if (lux)
    state["luminosity"] = *lux;
  if (north)
    state["north"] = *north;
  if (spec::info(robot.kind().robot).robot == spec::Robot::Rvr)
    state["color"] = color_json({});
  return state;
}

ordered_json EduRuns::Run::tell() {
  return {{"now", robot::in_seconds(time())},
          {"state", state()},
          {"events", std::exchange(events, ordered_json::array())}};
}

Answer EduRuns::start(robot::Robot& robot, Request& request) {
  if (const auto found = runs_.find(&robot); found != runs_.end() && request.params.contains("at"))
    return found->second->ready(request.params);
  runs_.erase(&robot);
  auto run = std::make_shared<Run>(robot);
  robot.connect();
  runs_[&robot] = run;
  if (request.flag("linked")) {
    run->reins.emplace(robot.kind().robot);
    return run->ready(request.params);
  }
  auto& own = run->own.emplace(run->line, robot.kind().robot, run::TetherBudgets{});
  const auto first = own.begin(run::Aim::Zero);
  if (!first) {
    runs_.erase(&robot);
    return refuse(first.error());
  }
  run->begin(own, *first);
  return print(run->tell());
}

namespace {

tl::unexpected<Problem> none_runs() {
  return refuse(ExitCode::Usage, "no program drives this robot");
}

} // namespace

Answer EduRuns::step(robot::Robot& robot, Request& request) {
  const auto found = runs_.find(&robot);
  if (found == runs_.end() || found->second->tether == nullptr)
    return none_runs();
  auto& run = *found->second;
  run.perform(request);
  const auto until = robot::read_seconds(request.value<double>("until").value_or(0));
  if (!until)
    return refuse(ExitCode::Usage, until.error());
  if (run.reins)
    return run.step_on_link(request.params, *until);
  if (const auto stepped = run.step(run.origin + *until); !stepped)
    return refuse(stepped.error());
  return print(run.tell());
}

Answer EduRuns::end(robot::Robot& robot, Request& request, const std::function<void()>& arrived) {
  const auto found = runs_.find(&robot);
  if (found == runs_.end() || found->second->tether == nullptr)
    return none_runs();
  auto& run = *found->second;
  run.perform(request);
  if (run.reins)
    return run.end_on_link(request.params);
  const auto until = run.line.now() + patience;
  while (!run.hands->is_idle() && run.line.now() < until) {
    run.events = ordered_json::array();
    if (!run.step(run.line.now() + 10ms))
      break;
  }
  arrived();
  const bool stopped = run.tether->hold().has_value();
  runs_.erase(found);
  return print({{"stopped", stopped}});
}

void EduRuns::forget(const robot::Robot* robot) {
  if (robot != nullptr)
    runs_.erase(robot);
  else
    runs_.clear();
}

} // namespace orb::playground
