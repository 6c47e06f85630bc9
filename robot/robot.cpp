#include "robot/robot.h"

#include "base/render.h"
#include "base/text/utf8.h"
#include "compiler/load.h"
#include "vm/common/bluetooth.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::robot {
namespace {

/// The body of a robot that follows a remote one: it receives samples and passes no commands on.
struct ShadowBody final : vm::RemoteBody {
  void obey(const vm::Motion&) override {}
  void show(vm::Color) override {}
  void show_back(int) override {}
};

} // namespace

Robot::Robot(spec::Robot kind, Options options, report::Course course)
    : kind_(kind), options_(std::move(options)), course_(std::move(course)) {
  make();
}

Robot::~Robot() = default;

Robot::Robot(const Robot& other, World* world)
    : kind_(other.kind_), options_(other.options_), course_(other.course_), world_(world),
      pipe_(other.pipe_), arrived_(other.arrived_), matrix_(other.matrix_),
      back_led_(other.back_led_), collisions_(other.collisions_), bumps_(other.bumps_),
      journey_(other.journey_) {
  device_.emplace(*other.device_, static_cast<vm::Observer*>(this));
  device_->ball().tell_steps(nullptr);
}

std::unique_ptr<Robot> Robot::fork() const {
  return world_ == nullptr ? std::unique_ptr<Robot>(new Robot(*this, nullptr)) : nullptr;
}

/// Powers the robot on.
void Robot::make() {
  vm::BallOptions ball;
  ball.robot = kind_;
  ball.seed = options_.seed;
  ball.start = options_.start;
  ball.driving = options_.driving.value_or(spec::driving(kind_));
  const auto& firmware = spec::info(options_.firmware);
  ball.firmware = firmware.firmware;
  ball.ram_bytes = firmware.ram_bytes();
  ball.loader = compiler::load;
  ball.observer = this;
  // Robots with packets v2 have no serial wire, only Bluetooth LE.
  ball.wire = kind().packets == spec::Packets::V2 ? vm::Wire::Unpaced : vm::Wire::Paced;
  matrix_.reset();
  back_led_ = 0;
  collisions_ = bumps_ = 0;
  arrived_.clear();
  journey_.reset();
  watcher_ = nullptr;
  if (options_.keep == Keep::Journey) {
    journey_.emplace().set_robot(kind_);
    journey_->set_course(course_);
  }
  pipe_.reset();
  if (options_.fault)
    pipe_.emplace(*options_.fault, kind().packets);
  device_.emplace(ball);
  device_->ball().schedule(course_.stimuli());
  if (journey_)
    on_event({}, vm::event::Position{});
}

void Robot::reset() {
  if (world_ != nullptr)
    return world_->reset();
  restart();
}

/// Switches it off and on; the client stays.
void Robot::restart() {
  const bool was_connected = connected();
  make();
  if (was_connected)
    connect();
}

void Robot::connect() {
  if (pipe_)
    pipe_->reconnect(device_->now());
  device_->connect();
}

void Robot::disconnect() {
  arrived_.clear();
  device_->disconnect();
}

bool Robot::connected() const {
  return ball().connected() && !(pipe_ && pipe_->cut());
}

void Robot::write(ByteView bytes) {
  if (!connected())
    return;
  if (!pipe_)
    device_->receive(bytes);
  else {
    pipe_->push(protocol::Direction::ToBall, bytes, device_->now());
    exchange();
  }
}

Bytes Robot::read() {
  exchange();
  return std::exchange(arrived_, {});
}

/// Delivers everything that has arrived at either end by now.
void Robot::exchange() {
  const auto now = device_->now();
  const auto take = [&](protocol::Direction direction, auto act) {
    for (auto bytes = pipe_->take(direction, now); !bytes.empty();
         bytes = pipe_->take(direction, now))
      act(bytes);
  };
  if (pipe_)
    take(protocol::Direction::ToBall, [&](const Bytes& bytes) { device_->receive(bytes); });
  while (const auto packet = device_->take_packet()) {
    if (pipe_)
      pipe_->push(protocol::Direction::FromBall, *packet, now);
    else
      arrived_.insert(arrived_.end(), packet->begin(), packet->end());
  }
  if (pipe_)
    take(protocol::Direction::FromBall,
         [&](const Bytes& bytes) { arrived_.insert(arrived_.end(), bytes.begin(), bytes.end()); });
}

Duration Robot::now() const {
  return device_->now().time_since_epoch();
}

void Robot::advance(Duration time) {
  if (world_ != nullptr)
    return world_->advance(time);
  live_until(device_->now() + std::max(time, Duration{}));
}

void Robot::live_until(Instant time) {
  const auto halt = world_ == nullptr ? vm::Ball::Halt::Look : vm::Ball::Halt::Pass;
  if (!pipe_)
    return device_->advance_to(time, halt);
  while (device_->now() < time) {
    // Messages must enter the link when they are sent: at the latest after a millisecond.
    constexpr Duration glance = 1ms;
    const auto event = device_->next_event();
    const auto said = event < time ? event + glance : time;
    device_->advance_to(std::clamp(std::min(said, pipe_->next_due()), device_->now(), time), halt);
    exchange();
  }
}

std::optional<Duration> Robot::next_event() const {
  const auto next = std::min(device_->next_event(), pipe_ ? pipe_->next_due() : never);
  if (!arrived_.empty())
    return now();
  return next == never ? std::nullopt : std::optional(next.time_since_epoch());
}

std::string Robot::address() const {
  return vm::bluetooth_address(options_.seed);
}

State Robot::state() const {
  const auto& ball = this->ball();
  State state;
  state.t = now();
  state.pose = ball.body().world_pose();
  state.rgb = ball.led();
  state.back_led = back_led_;
  state.matrix = matrix_;
  state.volts = ball.body().battery_v();
  state.charge = spec::charge(spec::battery(kind_), state.volts);
  state.way_cm = ball.body().way_cm();
  state.asleep = device_->asleep();
  state.connected = connected();
  state.program_runs = ball.basic_running();
  state.macro_runs = ball.macros().running();
  state.drives = ball.body().is_driven();
  state.collisions = collisions_;
  state.bumps = bumps_;
  return state;
}

report::Journey Robot::journey() const {
  if (!journey_)
    return {};
  auto journey = *journey_;
  journey.add(now(), vm::event::Position{ball().body().world_pose()});
  journey.finish(now(), "end", "ended");
  return journey;
}

void Robot::watch(vm::Observer* events, vm::StepObserver* steps) {
  watcher_ = events;
  device_->ball().tell_steps(steps);
}

void Robot::on_event(Instant at, const vm::Event& event) {
  if (watcher_ != nullptr)
    watcher_->on_event(at, event);
  if (const auto* picture = std::get_if<vm::event::Matrix>(&event))
    matrix_ = picture->pixels;
  else if (std::holds_alternative<vm::event::Led>(event))
    matrix_.reset();
  else if (const auto* back = std::get_if<vm::event::BackLed>(&event))
    back_led_ = back->value;
  else if (std::holds_alternative<vm::event::Collision>(event))
    ++collisions_;
  else if (std::holds_alternative<vm::event::Bump>(event))
    ++bumps_;
  if (!journey_ || !device_) // without a device it is still under construction
    return;
  // A client may redefine 0,0; the page uses places of the world.
  const bool moved = std::holds_alternative<vm::event::Position>(event);
  journey_->add(at.time_since_epoch(),
                moved ? vm::event::Position{ball().body().world_pose()} : event);
  journey_->sample(at.time_since_epoch(), ball().body());
}

tl::expected<void, std::string> Robot::stimulus(std::string_view line) {
  const auto [script, at_once] = vm::read_live_stimulus(line);
  if (!script.diagnostics.empty())
    return tl::unexpected(to_printable(in_one_line(script.diagnostics.front())));
  for (auto event : script.events) {
    if (!at_once && event.at < now())
      return tl::unexpected(fmt::format(
          "it is {:.3f} s already; write a later time, or leave out `at`", in_seconds(now())));
    event.at -= at_once ? Duration{} : now();
    device_->ball().schedule({&event, 1});
  }
  if (at_once)
    live_until(device_->now());
  return {};
}

void Robot::feel(const vm::Sample& sample) {
  static ShadowBody elsewhere;
  device_->ball().become(elsewhere);
  device_->ball().feel(sample);
}

vm::Outlook Robot::outlook() const {
  const auto push = ball().next_push();
  return {ball().body().place(), ball().body().most_speed_cm_s(),
          push == never ? Duration::max() : push.time_since_epoch()};
}

void Robot::meet(const vm::Shove& shove, std::span<const std::string> names) {
  device_->ball().meet(shove, names);
}

// The world.

tl::expected<Robot*, std::string> World::add(spec::Robot kind, Options options) {
  if (options.name.empty())
    options.name = std::to_string(robots_.size() + 1);
  for (const auto& other : robots_) {
    if (other->options_.name == options.name)
      return tl::unexpected(
          fmt::format("there is a robot `{}` already; give each its own name", options.name));
    const auto place = other->ball().body().place();
    const double apart =
        std::hypot(place.x - options.start.place.x, place.y - options.start.place.y);
    if (apart < 2 * spec::ball::radius)
      return tl::unexpected(fmt::format(
          "`{}` would stand in `{}`: their middles are {:.1f} cm apart, and {:.1f} is the least",
          options.name, other->options_.name, apart, 2 * spec::ball::radius));
  }
  auto robot = std::make_unique<Robot>(kind, std::move(options), course_);
  robot->live_until(Instant{now()});
  robot->world_ = this;
  join(*robot);
  robots_.push_back(std::move(robot));
  return robots_.back().get();
}

void World::advance(Duration time) {
  room_.advance_to(room_.now() + std::max(time, Duration{}));
  for (const auto& robot : robots_) // a robot that has come to rest reports so
    robot->device_->advance_to(Instant{now()});
}

void World::reset() {
  room_ = {};
  for (const auto& robot : robots_) {
    robot->restart();
    join(*robot);
  }
}

std::unique_ptr<World> World::fork() const {
  auto fork = std::make_unique<World>(course_);
  std::vector<vm::Resident*> residents;
  for (const auto& robot : robots_) {
    fork->robots_.emplace_back(new Robot(*robot, fork.get()));
    residents.push_back(fork->robots_.back().get());
  }
  fork->room_ = vm::Room(room_, residents);
  return fork;
}

} // namespace orb::robot
