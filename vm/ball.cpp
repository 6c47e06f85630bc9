#include "vm/ball.h"

#include "spec/macro.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::vm {

namespace {

using spec::BasicError;
using spec::BasicFlag;
using spec::Limit;
using spec::MacroFlag;
using spec::Statement;
using spec::Variable;

constexpr Duration pose_interval = std::chrono::milliseconds{50};
constexpr Duration sleep_warning = std::chrono::seconds{10};  // API §Async messages
constexpr Color battery_warning{255, 0, 0};                   // [?]
constexpr Duration id_blink = std::chrono::milliseconds{500}; // [?]
constexpr std::array<Color, 3> id_colors{Color{255, 0, 0}, Color{0, 255, 0},
                                         Color{0, 0, 255}}; // [?]
constexpr double impact_per_power = 28; // LL §Interpreting the Reported values: 6100 / 215
constexpr auto print_queue_bytes = static_cast<std::size_t>(spec::value_of(Limit::PrintQueueBytes));
/// Async messages other than prints and errors are dropped while more than this waits [?].
constexpr std::size_t congested_bytes = 4096;

constexpr bool has(std::uint32_t flags, BasicFlag flag) {
  return (flags & static_cast<std::uint32_t>(flag)) != 0;
}

constexpr bool has(std::uint32_t flags, MacroFlag flag) {
  return (flags & static_cast<std::uint32_t>(flag)) != 0;
}

std::int32_t rounded(double value) {
  return static_cast<std::int32_t>(std::lround(value));
}

std::int32_t rounded_s16(double value) {
  return static_cast<std::int32_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

} // namespace

Ball::Ball(const BallOptions& options)
    : options_(options), body_(options.seed),
      machine_(options.lines_per_second, options.seed, options.dispatch, options.native,
               options.native_programs), macros_(*this),
      dispatcher_(options.seed), inactive_at_(Instant{} + settings_.inactivity_timeout) {
  if (options_.trace_lines)
    machine_.trace_lines();
}

void Ball::trace(const Event& event) {
  if (options_.observer)
    options_.observer->on_event(now_, event);
}

// The link.

void Ball::connect() {
  if (asleep_)
    wake();
  if (connected_)
    return;
  connected_ = true;
  client_was_active();
  show_led();
}

void Ball::disconnect() {
  if (!connected_)
    return;
  connected_ = false;
  application_led_.reset();
  dispatcher_.on_disconnect(*this);
  streamer_.stop();
  output_.clear();
  show_led();

  const bool macro_forbids = macros_.running() && !has(macros_.flags(), MacroFlag::AllowSod);
  const bool basic_forbids = machine_.running() && !has(basic_flags_, BasicFlag::StopOnDisconnect);
  if ((settings_.temporary_flags & option::stop_on_disconnect) && !macro_forbids &&
      !basic_forbids) {
    body_.brake();
    settings_.temporary_flags &= ~option::stop_on_disconnect;
  }
}

void Ball::receive(ByteView bytes) {
  if (connected_ && !asleep_)
    dispatcher_.receive(bytes, *this);
}

std::optional<Bytes> Ball::take_packet() {
  return output_.take(now_);
}

Bytes Ball::take_output() {
  Bytes all;
  while (const auto packet = output_.take(now_))
    all.insert(all.end(), packet->begin(), packet->end());
  return all;
}

void Ball::send(const protocol::Response& response) {
  if (!connected_)
    return;
  output_.push(protocol::encode(response), now_, Output::Kind::Answer);
  ++sent_;
}

void Ball::send(const protocol::Async& async) {
  if (!connected_)
    return;
  if (holding_) {
    held_.push_back(async);
    return;
  }
  const auto id = static_cast<spec::AsyncId>(async.id);
  const bool vital = id == spec::AsyncId::BasicPrint || id == spec::AsyncId::BasicErrorText ||
                     id == spec::AsyncId::BasicError;
  if (!vital && output_.waiting(now_) > congested_bytes) {
    ++dropped_;
    return;
  }
  output_.push(protocol::encode(async), now_, Output::Kind::Message);
  ++sent_;
}

void Ball::release_messages() {
  holding_ = false;
  for (const auto& async : std::exchange(held_, {}))
    send(async);
}

// Time.

Instant Ball::next_housekeeping() const {
  Instant next = std::min({motion_deadline_, watch_at_, wake_at_});
  if (!asleep_) {
    next = std::min(next, warned_ ? inactive_at_ : inactive_at_ - sleep_warning);
    if (battery_state_ == 2)
      next = std::min(next, body_.battery_reaches(settings_.low_battery_cv / 100.0));
    else if (battery_state_ == 3)
      next = std::min(next, body_.battery_reaches(settings_.critical_battery_cv / 100.0));
    if (options_.observer && !connected_ && !basic_led_ && !macro_led_)
      next = std::min(next, now_ - now_.time_since_epoch() % id_blink + id_blink);
  }
  if (!script_.empty())
    next = std::min(next, Instant{} + script_.back().at);
  return next;
}

Instant Ball::next_simulation_event() const {
  const Instant house = std::min(next_housekeeping(), dispatcher_.next_event());
  if (falls_asleep_)
    return now_;
  return asleep_
             ? house
             : std::min({house, body_.next_step(), macros_.next_event(), streamer_.next_event()});
}

Instant Ball::next_event() const {
  return std::max(now_,
                  std::min({next_simulation_event(), machine_.next_event(), output_.next_event()}));
}

void Ball::advance_to(Instant target) {
  advance(target, Until::Target);
}

void Ball::advance_until_quiet(Instant target) {
  interrupted_ = false;
  advance(target, Until::Quiet);
}

void Ball::advance(Instant target, Until until) {
  for (;;) {
    if (until == Until::Quiet) {
      if (!idle())
        idle_since_.reset();
      else if (!idle_since_)
        idle_since_ = now_;
      if (interrupted_ || quiet())
        return;
      if (idle_since_) // only output has to leave
        target = std::min(target, output_.drained_to(0, now_));
    }
    const Instant event = next_simulation_event();
    const Instant limit = std::min(event, target + Duration{1});
    if (answer_input())
      continue;
    if (machine_.next_event() < limit) {
      machine_.run(limit, *this);
      now_ = std::max(now_, machine_.now());
      finish_basic();
      continue;
    }
    if (event > target)
      break;
    run_events(target);
  }
  now_ = std::max(now_, target);
  body_.advance_to(now_);
}

bool Ball::answer_input() {
  if (inputs_.empty() || !machine_.waits_for_input())
    return false;
  machine_.deliver_input(inputs_.front(), now_);
  inputs_.pop_front();
  finish_basic();
  return true;
}

bool Ball::quiet() const {
  return idle() && output_.waiting(now_) == 0;
}

bool Ball::idle() const {
  const bool waits_in_vain = machine_.waits_for_input() && machine_.next_event() == never &&
                             inputs_.empty() &&
                             std::none_of(script_.begin(), script_.end(), [](const auto& event) {
                               return std::holds_alternative<stimulus::Number>(event.stimulus);
                             });
  return (!machine_.running() || waits_in_vain) && !macros_.running() && wake_at_ == never &&
         !falls_asleep_;
}

void Ball::run_events(Instant bound) {
  // Motion goes on until something else happens, or until it causes something to happen.
  const Instant others =
      std::min({next_housekeeping(), dispatcher_.next_event(), macros_.next_event(),
                streamer_.next_event(), machine_.next_event(), bound});
  now_ = std::max(now_, body_.advance_to(std::max(now_, others)));
  if (const auto impact = body_.take_impact())
    detect_collision(*impact);
  watch_motion();
  keep_house();
  while (!script_.empty() && Instant{} + script_.back().at <= now_) {
    const auto stimulus = script_.back().stimulus;
    script_.pop_back();
    apply(stimulus);
  }
  if (dispatcher_.next_event() <= now_)
    dispatcher_.run(now_, *this);
  if (!asleep_ && macros_.next_event() <= now_)
    macros_.advance_to(now_);
  macros_changed();
  if (!asleep_ && streamer_.next_event() <= now_)
    streamer_.run(now_, *this);
  if (falls_asleep_)
    fall_asleep();
}

void Ball::watch_motion() {
  const bool moving = body_.moving() && !asleep_;
  if (moving && !was_moving_) {
    watch_at_ = now_;
    dispatcher_.on_motion(*this);
  }
  if (now_ >= watch_at_ || (was_moving_ && !moving)) {
    trace(event::Position{body_.pose()});
    check_battery();
    watch_at_ = moving ? now_ + pose_interval : never;
  }
  was_moving_ = moving;
}

void Ball::keep_house() {
  if (now_ >= wake_at_)
    wake();
  if (now_ >= motion_deadline_) {
    motion_deadline_ = never;
    if (!exclusive_ && (settings_.permanent_flags & option::motion_timeout))
      body_.brake();
  }
  if (!asleep_) {
    check_battery();
    show_led();
    if (keeps_awake() && now_ >= inactive_at_ - sleep_warning)
      client_was_active();
    if (!warned_ && now_ >= inactive_at_ - sleep_warning) {
      warned_ = true;
      send(protocol::make_async(spec::AsyncId::PreSleepWarning));
    }
    if (now_ >= inactive_at_)
      sleep({});
  }
}

bool Ball::keeps_awake() const {
  return (machine_.running() && !has(basic_flags_, BasicFlag::Stealth)) ||
         (macros_.running() && !has(macros_.flags(), MacroFlag::Stealth));
}

void Ball::client_was_active() {
  inactive_at_ = now_ + settings_.inactivity_timeout;
  warned_ = false;
}

void Ball::settings_changed() {
  body_.set_vector_drive(settings_.permanent_flags & option::vector_drive ? Switch::On
                                                                          : Switch::Off);
  if (!(settings_.permanent_flags & option::motion_timeout))
    motion_deadline_ = never;
  check_battery();
  show_led();
  show_back_led(back_led_);
}

std::uint32_t Ball::clock_ms() const {
  return static_cast<std::uint32_t>((now_.time_since_epoch() + clock_offset_) /
                                    std::chrono::milliseconds{1});
}

void Ball::set_clock_ms(std::uint32_t value) {
  clock_offset_ = std::chrono::milliseconds{value} - now_.time_since_epoch();
}

std::optional<Instant> Ball::wake_up() const {
  if (wake_at_ == never)
    return std::nullopt;
  return wake_at_;
}

// Stimuli.

void Ball::schedule(std::span<const TimedStimulus> script) {
  for (const auto& event : script)
    script_.push_back({now_.time_since_epoch() + event.at, event.stimulus});
  std::reverse(script_.end() - static_cast<std::ptrdiff_t>(script.size()), script_.end());
  std::stable_sort(script_.begin(), script_.end(),
                   [](const auto& a, const auto& b) { return a.at > b.at; });
}

namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

} // namespace

void Ball::apply(const Stimulus& stimulus) {
  body_.advance_to(now_);
  std::visit(Overloaded{
                 [&](const Wall& wall) { body_.add_wall(wall); },
                 [&](const stimulus::Shake&) {
                   if (asleep_)
                     wake();
                   double_shake_ = true;
                   body_.shake();
                 },
                 [&](const stimulus::Toss& toss) { body_.toss(toss.time); },
                 [&](const stimulus::Push& push) {
                   body_.push(push.heading_deg, push.strength);
                   if (const auto impact = body_.take_impact())
                     detect_collision(*impact);
                 },
                 [&](const stimulus::ClientRoll& client) { roll(Actor::Client, client.roll); },
                 [&](const stimulus::ClientColor& client) { set_led(Actor::Client, client.color); },
                 [&](const stimulus::Connect&) { connect(); },
                 [&](const stimulus::Disconnect&) { disconnect(); },
                 [&](const stimulus::Battery& battery) { body_.set_battery(battery.volts); },
                 [&](const stimulus::Charger& charger) { body_.set_charger(charger.state); },
                 [&](const stimulus::Number& number) { deliver_input(number.value); },
                 [&](const stimulus::Tilt& tilt) { body_.tilt(tilt.pitch_deg, tilt.roll_deg); },
                 [&](const stimulus::Spin& spin) { body_.spin(spin.deg_per_s); },
                 [&](const stimulus::Noise& noise) { body_.set_noise(noise.state); },
             },
             stimulus);
  check_battery();
  watch_motion();
}

void Ball::detect_collision(const Impact& impact) {
  const auto& settings = settings_.collisions;
  if (asleep_ || settings.method == 0 || now_ < deaf_until_)
    return;
  const auto exceeds = [&](double power, int threshold, int by_speed) {
    return threshold != 0 && std::abs(power) > threshold + by_speed * impact.speed / 255.0;
  };
  event::Collision collision;
  collision.axis = (exceeds(impact.x_power, settings.x_threshold, settings.x_speed) ? 1 : 0) |
                   (exceeds(impact.y_power, settings.y_threshold, settings.y_speed) ? 2 : 0);
  if (collision.axis == 0)
    return;
  deaf_until_ = now_ + std::chrono::milliseconds{10} * settings.dead_time_10ms;
  collision.x = rounded_s16(impact.x_power * impact_per_power);
  collision.y = rounded_s16(impact.y_power * impact_per_power);
  collision.x_magnitude = rounded_s16(std::abs(impact.x_power));
  collision.y_magnitude = rounded_s16(std::abs(impact.y_power));
  collision.speed = impact.speed;
  trace(collision);

  send(protocol::make_async(spec::AsyncId::Collision,
                            {collision.x, collision.y, 0, collision.axis, collision.x_magnitude,
                             collision.y_magnitude, collision.speed, clock_ms()}));
  macros_.collide(now_);
  dispatcher_.on_collision(*this);
}

int Ball::battery_state() const {
  return battery_state_;
}

void Ball::check_battery() {
  const int centivolts = static_cast<int>(std::ceil(body_.battery_v() * 100 - 1e-6));
  const int state = body_.charging()                              ? 1
                    : centivolts <= settings_.critical_battery_cv ? 4
                    : centivolts <= settings_.low_battery_cv      ? 3
                                                                  : 2;
  if (state == battery_state_)
    return;
  battery_state_ = state;
  show_led();
  dispatcher_.on_battery(*this);
}

// Lamps.

Color Ball::led_now() const {
  if (asleep_)
    return {};
  if (battery_state_ == 3 || battery_state_ == 4)
    return battery_warning;
  const bool basic_first = machine_.running() && has(basic_flags_, BasicFlag::KeepLed);
  if (macro_led_ && !(basic_first && basic_led_))
    return *macro_led_;
  if (basic_led_)
    return *basic_led_;
  if (!connected_)
    return id_colors[static_cast<std::size_t>(now_.time_since_epoch() / id_blink) %
                     id_colors.size()];
  return application_led_.value_or(settings_.user_color);
}

void Ball::show_led() {
  const Color color = led_now();
  if (color == body_.led())
    return;
  body_.show(color);
  trace(event::Led{color});
}

void Ball::show_back_led(int level) {
  back_led_ = level;
  const bool always = (settings_.permanent_flags & option::tail_led_always_on) != 0;
  const int shown = asleep_ ? 0 : always ? 255 : level;
  if (shown == body_.back_led())
    return;
  body_.show_back(static_cast<std::uint8_t>(shown));
  trace(event::BackLed{shown});
}

void Ball::set_led(Actor actor, Color color) {
  switch (actor) {
  case Actor::Client:
    application_led_ = client_color_ = color;
    new_color_ = true;
    break;
  case Actor::Basic: basic_led_ = color; break;
  case Actor::Macro: macro_led_ = color; break;
  }
  show_led();
}

void Ball::set_back_led(Actor, int level) {
  show_back_led(level);
}

// Driving.

void Ball::update_exclusive() {
  const bool basic = machine_.running() && has(basic_flags_, BasicFlag::ExclusiveDrive);
  const bool macro = macros_.running() && has(macros_.flags(), MacroFlag::ExclusiveDrv);
  if (exclusive_ && !(*exclusive_ == Actor::Basic ? basic : macro))
    exclusive_.reset();
  if (!exclusive_ && basic)
    exclusive_ = Actor::Basic;
  if (!exclusive_ && macro)
    exclusive_ = Actor::Macro;
}

void Ball::moved() {
  motion_deadline_ =
      settings_.permanent_flags & option::motion_timeout ? now_ + settings_.motion_timeout : never;
  watch_motion();
}

void Ball::roll(Actor actor, const Roll& roll) {
  if (actor == Actor::Client) {
    client_roll_ = roll;
    new_roll_ = true;
  }
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.roll(roll);
  trace(event::Drive{roll});
  moved();
}

void Ball::rotate(Actor actor, int angle_deg, Duration time) {
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.rotate(angle_deg, time);
  moved();
}

void Ball::set_motors(Actor actor, Motor left, Motor right) {
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.set_motors(left, right);
  moved();
}

void Ball::set_heading(Actor actor, int heading_deg) {
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.set_heading(heading_deg);
}

void Ball::set_stabilization(Actor actor, Stabilization mode) {
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.set_stabilization(mode);
  watch_motion();
}

void Ball::set_rotation_rate(Actor, double deg_per_s) {
  body_.advance_to(now_);
  body_.set_rotation_rate(deg_per_s);
}

void Ball::stop(Actor actor) {
  if (!may_drive(actor))
    return;
  body_.advance_to(now_);
  body_.brake();
}

// MacroHost.

void Ball::roll(const Roll& roll) {
  this->roll(Actor::Macro, roll);
}
void Ball::rotate(int angle_deg, Duration time) {
  rotate(Actor::Macro, angle_deg, time);
}
void Ball::set_motors(Motor left, Motor right) {
  set_motors(Actor::Macro, left, right);
}
void Ball::set_heading(int heading_deg) {
  set_heading(Actor::Macro, heading_deg);
}
void Ball::set_stabilization(Stabilization mode) {
  set_stabilization(Actor::Macro, mode);
}
void Ball::set_rotation_rate(double deg_per_s) {
  set_rotation_rate(Actor::Macro, deg_per_s);
}
void Ball::set_led(Color color) {
  set_led(Actor::Macro, color);
}
void Ball::set_back_led(int level) {
  set_back_led(Actor::Macro, level);
}

void Ball::configure_collisions(const CollisionSettings& settings) {
  settings_.collisions = settings;
}

void Ball::set_speed(int speed) {
  const auto heading = static_cast<int>(std::lround(body_.heading_setpoint_deg())) % 360;
  roll(Actor::Macro, {heading, speed, speed == 0 ? Go::Brake : Go::Drive});
}

void Ball::stop_motors() {
  stop(Actor::Macro);
}

void Ball::emit_marker(int marker, int macro, int command) {
  trace(event::Marker{marker, macro, command});
  send(protocol::make_async(spec::AsyncId::MacroMarker, {marker, macro, command}));
}

void Ball::trace_command(int macro, int command) {
  trace(event::Macro{macro, command});
}

void Ball::sleep_ms(int time_ms) {
  if (time_ms == spec::macro_sleep_inherit)
    sleep({wake_up_.seconds, 0, 0, wake_up_.milliseconds});
  else
    sleep({time_ms / 1000, 0, 0, time_ms % 1000});
}

MacroOutcome Ball::run_macro(int id) {
  const auto outcome = macros_.start(id, now_);
  macros_changed();
  return outcome;
}

void Ball::macros_changed() {
  if (macro_ran_ && !macros_.running()) {
    macro_led_.reset();
    if (!has(basic_flags_, BasicFlag::Stealth))
      client_was_active();
    show_led();
  }
  macro_ran_ = macros_.running();
  update_exclusive();
}

// Sleep.

void Ball::shut_down() {
  abort_basic();
  macros_.abort(now_);
  macros_changed();
  streamer_.stop();
  stop(Actor::Client);
}

void Ball::sleep(const Sleep& sleep) {
  falls_asleep_ = sleep;
}

void Ball::fall_asleep() {
  const Sleep sleep = *falls_asleep_;
  falls_asleep_.reset();
  wake_up_ = sleep;
  const Duration time =
      std::chrono::seconds{sleep.seconds} + std::chrono::milliseconds{sleep.milliseconds};
  wake_at_ = time == Duration{} ? never : now_ + time;
  trace(event::Sleep{sleep.seconds, sleep.macro, sleep.line});
  machine_.stop(event::End::Reason::Sleep);
  finish_basic();
  macros_.fall_asleep(now_);
  macros_changed();
  dispatcher_.on_sleep(*this);
  streamer_.stop();
  connected_ = false; // what is queued still leaves
  area_text(Area::Ram).clear();
  const Settings kept = settings_;
  settings_ = {};
  settings_.user_color = kept.user_color;
  settings_.permanent_flags = kept.permanent_flags;
  settings_.low_battery_cv = kept.low_battery_cv;
  settings_.critical_battery_cv = kept.critical_battery_cv;
  settings_.inactivity_timeout = kept.inactivity_timeout;
  application_led_.reset();
  new_roll_ = new_color_ = double_shake_ = false;
  motion_deadline_ = never;
  body_.power_on();
  asleep_ = true;
  watch_motion();
  show_led();
  show_back_led(0);
}

void Ball::wake() {
  const Sleep plan = wake_at_ <= now_ ? wake_up_ : Sleep{};
  asleep_ = false;
  body_.advance_to(now_);
  body_.power_on();
  dispatcher_.on_wake(*this);
  client_was_active();
  check_battery();
  show_led();
  if (plan.macro != 0) {
    macros_.start(plan.macro, now_);
    macros_changed();
  }
  if (plan.line != 0)
    execute_basic(Area::Flash, plan.line);
  wake_at_ = never; // only now: in between the ball is not idle
}

// orbBasic.

std::string_view Ball::basic_text(Area area) const {
  return areas_[static_cast<std::size_t>(area)];
}

Outcome Ball::erase_basic(Area area) {
  if (machine_.running() && running_area_ == area)
    return Outcome::Refused;
  area_text(area).clear();
  return Outcome::Done;
}

Outcome Ball::append_basic(Area area, ByteView text) {
  if (machine_.running() && running_area_ == area)
    return Outcome::Refused;
  auto& stored = area_text(area);
  if (!stored.empty() && stored.back() == '\0')
    return Outcome::Done;
  const auto end = std::find(text.begin(), text.end(), std::uint8_t{0});
  const auto kept = as_text(
      text.first(static_cast<std::size_t>(end - text.begin()) + (end == text.end() ? 0u : 1u)));
  const std::size_t room = area == Area::Ram
                               ? options_.ram_bytes
                               : static_cast<std::size_t>(spec::value_of(Limit::FlashBytes));
  if (stored.size() + kept.size() > room)
    return Outcome::Refused;
  stored += kept;
  return Outcome::Done;
}

Outcome Ball::commit_basic() {
  if (machine_.running() && running_area_ == Area::Flash)
    return Outcome::Refused;
  area_text(Area::Flash) = area_text(Area::Ram);
  return Outcome::Done;
}

Outcome Ball::execute_basic(Area area, int line) {
  if (machine_.running())
    return Outcome::Refused;
  std::string_view text = basic_text(area);
  if (text.ends_with('\0'))
    text.remove_suffix(1);
  running_area_ = area;
  basic_flags_ = 0;
  machine_.start(options_.loader ? options_.loader(text) : bytecode::Chunk{}, line, now_);
  return Outcome::Done;
}

void Ball::abort_basic() {
  if (!machine_.running())
    return;
  machine_.abort();
  finish_basic();
}

void Ball::deliver_input(std::int32_t value) {
  machine_.deliver_input(value, now_);
}

void Ball::report_error(int line, BasicError error) {
  trace(event::Error{line, error});
  const auto text = fmt::format("Line {}: {}\n", line, spec::info(error).text);
  send(protocol::make_async(spec::AsyncId::BasicErrorText, {as_bytes(text)}));
  send(protocol::make_async(spec::AsyncId::BasicError, {line, spec::code(error)}));
}

void Ball::finish_basic() {
  const auto stop = machine_.take_stop();
  if (!stop)
    return;
  if (stop->error)
    report_error(stop->line, *stop->error);
  if (!has(basic_flags_, BasicFlag::Stealth))
    client_was_active();
  trace(event::End{stop->reason, stop->lines});
  basic_flags_ = 0;
  basic_led_.reset();
  update_exclusive();
  show_led();
}

std::int32_t Ball::read(Variable variable, Instant now) {
  now_ = now;
  body_.advance_to(now);
  const auto take = [](bool& flag) { return std::exchange(flag, false) ? 1 : 0; };
  constexpr double g = 4096; // accelerometer units
  switch (variable) {
  case Variable::TimerA:
  case Variable::TimerB:
  case Variable::TimerC: break; // the machine's own
  case Variable::Ctrl: return body_.stabilized() ? 1 : 0;
  case Variable::Speed: return body_.speed();
  case Variable::Yaw: return rounded(body_.yaw_deg()) % 360;
  case Variable::Pitch: return rounded(body_.pitch_deg());
  case Variable::Roll: return rounded(body_.roll_deg());
  case Variable::AccelX: return rounded_s16(body_.acceleration_g().x * g);
  case Variable::AccelY: return rounded_s16(body_.acceleration_g().y * g);
  case Variable::AccelZ: return rounded_s16(body_.acceleration_g().z * g);
  case Variable::GyroX: return rounded(body_.rotation_deg_s().x * 10);
  case Variable::GyroY: return rounded(body_.rotation_deg_s().y * 10);
  case Variable::GyroZ: return rounded(body_.rotation_deg_s().z * 10);
  case Variable::Vbatt: return rounded(body_.battery_v() * 100);
  case Variable::Sbatt: return battery_state_;
  case Variable::Cmdroll: return take(new_roll_);
  case Variable::Spdval: return client_roll_.speed;
  case Variable::Hdgval: return client_roll_.heading_deg;
  case Variable::Cmdrgb: return take(new_color_);
  case Variable::Redval: return client_color_.red;
  case Variable::Grnval: return client_color_.green;
  case Variable::Bluval: return client_color_.blue;
  case Variable::Isconn: return connected_ ? 1 : 0;
  case Variable::Dshake: return take(double_shake_);
  case Variable::Accelone: return rounded(body_.acceleration_total_g() * 1000);
  case Variable::Xpos: return rounded_s16(body_.pose().x_cm);
  case Variable::Ypos: return rounded_s16(body_.pose().y_cm);
  case Variable::Qzero: return rounded(body_.attitude().w * 10000);
  case Variable::Qone: return rounded(body_.attitude().x * 10000);
  case Variable::Qtwo: return rounded(body_.attitude().y * 10000);
  case Variable::Qthree: return rounded(body_.attitude().z * 10000);
  case Variable::Macstat: return static_cast<std::int32_t>(macros_.macstat());
  }
  return 0;
}

std::optional<BasicError> Ball::write(Variable, std::int32_t value, Instant now) {
  // `ctrl` is the one that programs may assign.
  now_ = now;
  set_stabilization(Actor::Basic, value == 0 ? Stabilization::Off : Stabilization::On);
  return std::nullopt;
}

std::optional<Instant> Ball::print(std::string_view text, Instant now) {
  now_ = now;
  if (connected_) {
    Bytes packet =
        protocol::encode(protocol::make_async(spec::AsyncId::BasicPrint, {as_bytes(text)}));
    const std::size_t room = print_queue_bytes - std::min(print_queue_bytes, packet.size());
    if (const Instant ready = output_.drained_to(room, now); ready > now)
      return ready;
    output_.push(std::move(packet), now, Output::Kind::Message);
    ++sent_;
  }
  trace(event::Print{std::string(text)});
  return std::nullopt;
}

void Ball::line_ended(int line, Instant now) {
  now_ = now;
  trace(event::Line{line});
}

std::optional<BasicError> Ball::perform(Statement statement, std::span<const std::int32_t> values,
                                        Instant now) {
  now_ = now;
  const auto byte = [&](std::size_t n) { return static_cast<std::uint8_t>(values[n]); };
  switch (statement) {
  case Statement::Rgb: set_led(Actor::Basic, {byte(0), byte(1), byte(2)}); break;
  case Statement::Ledc: {
    const auto& row = spec::led_colours[byte(0)];
    set_led(Actor::Basic, {row.red, row.green, row.blue});
    break;
  }
  case Statement::BackLed: set_back_led(Actor::Basic, values[0]); break;
  case Statement::Goroll: {
    const Go go = values.size() > 2 ? static_cast<Go>(values[2])
                  : values[1] > 0   ? Go::Drive
                                    : Go::Brake;
    roll(Actor::Basic, {values[0], values[1], go});
    break;
  }
  case Statement::Heading: set_heading(Actor::Basic, values[0]); break;
  case Statement::Raw:
    set_motors(Actor::Basic, {static_cast<MotorMode>(values[0]), values[1]},
               {static_cast<MotorMode>(values[2]), values[3]});
    break;
  case Statement::Locate:
    body_.advance_to(now_);
    body_.locate(values[0], values[1]);
    break;
  case Statement::Basflg:
    basic_flags_ = static_cast<std::uint32_t>(values[0]);
    update_exclusive();
    show_led();
    break;
  case Statement::Sleep: sleep({values[0], values[1], values[2]}); break;
  case Statement::Macrun:
    if (!macros_.running())
      macros_.start(values[0], now_);
    macros_changed();
    break;
  case Statement::Mackill:
    macros_.abort(now_);
    macros_changed();
    break;
  case Statement::Reset:
    basic_flags_ = 0;
    update_exclusive();
    break;
  case Statement::Let:
  case Statement::If:
  case Statement::For:
  case Statement::Next:
  case Statement::Goto:
  case Statement::Gosub:
  case Statement::Return:
  case Statement::On:
  case Statement::Print:
  case Statement::Input:
  case Statement::Delay:
  case Statement::End:
  case Statement::Random:
  case Statement::Data:
  case Statement::Rstr:
  case Statement::Read:
  case Statement::Tron:
  case Statement::Troff: break; // the machine's own
  }
  return std::nullopt;
}

} // namespace orb::vm
