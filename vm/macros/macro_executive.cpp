#include "vm/macros/macro_executive.h"

#include "vm/macros/system_macros.h"

namespace orb::vm {
namespace {

using protocol::MacroHeader;
using protocol::MacroStep;
using spec::MacroCommand;
using spec::MacroFlag;

constexpr auto motor_ignore = static_cast<std::int32_t>(MotorMode::Ignore);

std::uint8_t byte(std::int32_t value) {
  return static_cast<std::uint8_t>(value);
}

Motor motor(std::int32_t mode, std::int32_t power) {
  // Undocumented modes leave the motor alone.
  return {static_cast<MotorMode>(std::min(mode, motor_ignore)), power};
}

double rate_deg_per_s(std::int32_t rate) {
  return 40 + rate / 2.0; // QR §Set Rotation Rate
}

Color color_of(const MacroStep& step) {
  return {byte(step.value[0]), byte(step.value[1]), byte(step.value[2])};
}

std::uint8_t blend(std::uint8_t from, std::uint8_t to, Duration elapsed, Duration time) {
  const auto way = (to - from) * (elapsed / 1ms) / (time / 1ms);
  return static_cast<std::uint8_t>(from + way);
}

} // namespace

MacroExecutive::MacroExecutive(const MacroExecutive& other, MacroHost& host)
    : MacroExecutive(other) {
  host_ = &host;
  code_ = store_.moved(code_, other.store_);
  for (auto& frame : stack_)
    frame.code = store_.moved(frame.code, other.store_);
}

std::vector<MacroExecutive::Place> MacroExecutive::places() const {
  std::vector<Place> all;
  if (!running())
    return all;
  all.push_back({id_, wake_ > now_ ? number_ : number_ + 1});
  for (std::size_t i = depth_; i-- > 0;)
    all.push_back({stack_[i].id, stack_[i].number});
  return all;
}

ByteView MacroExecutive::image_of(std::uint8_t id) const {
  for (const auto& macro : system_macros())
    if (macro.id == id)
      return macro.image;
  return store_.find(id);
}

bool MacroExecutive::inhibited(std::uint8_t flags) const {
  return spec::has_flag(flags, MacroFlag::InhIfConn) && host_->connected();
}

MacroOutcome MacroExecutive::start(int wanted, Instant now) {
  move_to(now);
  const auto id = static_cast<std::uint8_t>(wanted);
  if (wanted <= spec::macro_id_none || wanted > spec::macro_id_temporary ||
      id == spec::macro_id_stream)
    return MacroOutcome::BadParameter;
  if (running())
    return MacroOutcome::Busy;
  const auto image = image_of(id);
  const auto header = protocol::read_macro_header(image);
  if (!header)
    return MacroOutcome::NoSuchMacro;
  if (inhibited(header->flags))
    return MacroOutcome::Inhibited;
  begin();
  enter(id, header->flags, image.subspan(header->size));
  return MacroOutcome::Done;
}

void MacroExecutive::begin() {
  loop_ = {};
  depth_ = 0;
  collided_ = false;
  collision_target_ = spec::macro_id_none;
  rotating_until_ = now_;
  wake_ = now_;
  tick_ = now_;
}

void MacroExecutive::enter(std::uint8_t id, std::uint8_t flags, ByteView code) {
  id_ = id;
  flags_ = flags;
  code_ = code;
  next_ = 0;
  number_ = 0;
}

void MacroExecutive::end_buffer_macro() {
  if (id_ == spec::macro_id_temporary || id_ == spec::macro_id_stream ||
      (depth_ > 0 && stack_[0].id == spec::macro_id_temporary)) {
    finish(MacroEnding::Aborted);
    store_.close_temporary();
  }
}

MacroOutcome MacroExecutive::save_temporary(ByteView image, Instant now) {
  move_to(now);
  if (!protocol::read_macro_header(image) || image.size() > spec::macro_max_packet)
    return MacroOutcome::BadParameter;
  end_buffer_macro();
  store_.clear_buffer();
  store_.append_temporary(image);
  return MacroOutcome::Done;
}

MacroOutcome MacroExecutive::append_chunk(ByteView chunk, Instant now) {
  move_to(now);
  if (chunk.empty() || chunk.size() > spec::macro_max_packet)
    return MacroOutcome::BadParameter;
  end_buffer_macro();
  return store_.append_temporary(chunk) ? MacroOutcome::Done : MacroOutcome::NoRoom;
}

MacroOutcome MacroExecutive::save(ByteView image, Instant now) {
  move_to(now);
  const auto header = protocol::read_macro_header(image);
  if (!header || image.size() > spec::macro_max_packet)
    return MacroOutcome::BadParameter;
  switch (spec::macro_id_kind(header->id)) {
  case spec::MacroIdKind::None:
  case spec::MacroIdKind::System:
  case spec::MacroIdKind::Temporary: return MacroOutcome::BadParameter;
  case spec::MacroIdKind::Stream: return save_stream(*header, image.subspan(header->size));
  case spec::MacroIdKind::User:
    return store_.save_user(header->id, image) ? MacroOutcome::Done : MacroOutcome::NoRoom;
  }
  return MacroOutcome::BadParameter;
}

MacroOutcome MacroExecutive::save_stream(const MacroHeader& header, ByteView commands) {
  if (id_ == spec::macro_id_stream) {
    // Commands that a loop can return to must be kept, too.
    const auto live_from =
        loop_.id == spec::macro_id_stream && loop_.start < next_ ? loop_.start : next_;
    const auto shift = store_.append_stream(commands, live_from);
    if (!shift)
      return MacroOutcome::NoRoom;
    next_ -= *shift;
    if (loop_.id == spec::macro_id_stream)
      loop_.start -= *shift;
    code_ = store_.stream();
    if (wake_ == never)
      wake_ = next_tick();
    return MacroOutcome::Done;
  }
  if (inhibited(header.flags))
    return MacroOutcome::Inhibited;
  end_buffer_macro();
  if (running())
    return MacroOutcome::Busy;
  store_.clear_buffer();
  store_.append_stream(commands, 0);
  begin();
  enter(header.id, header.flags, store_.stream());
  return MacroOutcome::Done;
}

void MacroExecutive::reinitialize(Instant now) {
  move_to(now);
  if (running())
    finish(MacroEnding::Aborted);
  store_ = {};
  parameters_ = {};
  number_ = 0;
}

std::uint32_t MacroExecutive::macstat() const {
  return running() ? static_cast<std::uint32_t>(id_) << 16 | number_ : 0;
}

MacroStatus MacroExecutive::abort(Instant now) {
  move_to(now);
  if (!running()) {
    store_.close_temporary();
    return {};
  }
  if (has(MacroFlag::Unkillable) && spec::macro_id_kind(id_) == spec::MacroIdKind::System)
    return {id_, spec::macro_unkillable};
  const auto aborted = status();
  finish(MacroEnding::Aborted);
  store_.close_temporary();
  return aborted;
}

MacroOutcome MacroExecutive::set_parameter(std::uint8_t index, std::uint8_t value1,
                                           std::uint8_t value2) {
  const auto parameter = spec::find_macro_parameter(index);
  if (!parameter)
    return MacroOutcome::BadParameter;
  const auto word = static_cast<std::uint16_t>(value1 << 8 | value2);
  switch (*parameter) {
  case spec::MacroParameter::SystemDelay1: parameters_.sd1_ms = word; break;
  case spec::MacroParameter::SystemDelay2: parameters_.sd2_ms = word; break;
  case spec::MacroParameter::SystemSpeed1: parameters_.spd1 = value1; break;
  case spec::MacroParameter::SystemSpeed2: parameters_.spd2 = value1; break;
  case spec::MacroParameter::SystemLoops: parameters_.system_loops = value1; break;
  }
  return MacroOutcome::Done;
}

Instant MacroExecutive::next_event() const {
  if (!running())
    return never;
  auto next = wake_;
  // Waits, fades and collisions are polled every tick.
  if (fade_.active || waits_for_stop_ || (collided_ && collision_target_ != spec::macro_id_none))
    next = std::min(next, next_tick());
  return next;
}

Instant MacroExecutive::next_tick() const {
  const auto ticks = (now_ - tick_ + macro_tick - 1ns) / macro_tick;
  return tick_ + macro_tick * std::max<Duration::rep>(ticks, 1);
}

void MacroExecutive::advance_to(Instant now) {
  auto how = std::exchange(held_, false) ? Tick::GoesOn : Tick::Begins;
  while (running()) {
    const auto next = next_event();
    if (next > now)
      break;
    move_to(next);
    tick(std::exchange(how, Tick::Begins));
    if (held_)
      return;
  }
  move_to(now);
}

void MacroExecutive::collide(Instant now) {
  move_to(now);
  if (running() && collision_target_ != spec::macro_id_none)
    collided_ = true;
}

void MacroExecutive::fall_asleep(Instant now) {
  move_to(now);
  if (running())
    rest(MacroEnding::Slept);
  store_.forget_users();
}

void MacroExecutive::tick(Tick tick) {
  if (tick == Tick::Begins)
    begin_tick();
  while (running() && wake_ <= now_) {
    if (left_ == 0) {
      wake_ = now_ + macro_tick;
      return;
    }
    run_command();
    if (held_)
      return;
    --left_;
  }
}

void MacroExecutive::begin_tick() {
  tick_ = now_;
  left_ = macro_commands_per_tick;
  if (fade_.active)
    step_fade();
  if (collided_) {
    collided_ = false;
    if (collision_target_ != spec::macro_id_none) {
      waits_for_stop_ = false;
      wake_ = now_;
      go_to(collision_target_);
    }
  }
  if (waits_for_stop_ && (wake_ <= now_ || host_->stopped())) {
    waits_for_stop_ = false;
    wake_ = now_;
  }
}

void MacroExecutive::run_command() {
  if (next_ >= code_.size()) {
    if (id_ == spec::macro_id_stream)
      wake_ = never; // a stream pauses after its last chunk
    else
      reach_end();
    return;
  }
  const auto step = protocol::read_macro_command(code_, next_);
  const bool own = spec::macro_id_kind(id_) == spec::MacroIdKind::System;
  if (!step || (step->info->executive > version_ && !own))
    return finish(MacroEnding::BadCommand);
  if (!host_->may_begin()) {
    held_ = true;
    return;
  }
  ++number_;
  next_ += step->size;
  host_->trace_command(id_, number_);
  perform(*step);
}

void MacroExecutive::perform(const MacroStep& step) {
  const auto& value = step.value;
  switch (step.info->command) {
  case MacroCommand::End:
    if (id_ != spec::macro_id_stream)
      reach_end();
    return;
  case MacroCommand::SetSd1: parameters_.sd1_ms = static_cast<std::uint16_t>(value[0]); return;
  case MacroCommand::SetSd2: parameters_.sd2_ms = static_cast<std::uint16_t>(value[0]); return;
  case MacroCommand::Stabilization:
    // The vendor's reader treats unknown values as off.
    host_->drive(value[0] > static_cast<int>(Stabilization::On)
                     ? Stabilization::Off
                     : static_cast<Stabilization>(value[0]));
    return wait_ms(value[1]);
  case MacroCommand::SetHeading:
    host_->drive(SetHeading{0}); // the operand is ignored: M-16 in docs/using/macros.md
    return wait_ms(value[1]);
  case MacroCommand::Roll:
  case MacroCommand::Roll2: roll(value[0], value[1]); return wait_ms(value[2]);
  case MacroCommand::RollSd1: roll(value[0], value[1]); return wait_ms(parameters_.sd1_ms);
  case MacroCommand::RollSpd1Sd1:
    roll(parameters_.spd1, value[0]);
    return wait_ms(parameters_.sd1_ms);
  case MacroCommand::RollSpd2Sd1:
    roll(parameters_.spd2, value[0]);
    return wait_ms(parameters_.sd1_ms);
  case MacroCommand::SetSpeed: host_->drive(SetSpeed{value[0]}); return wait_ms(value[1]);
  case MacroCommand::Rgb:
    fade_.active = false;
    set_color(color_of(step));
    return wait_ms(value[3]);
  case MacroCommand::RgbSd2:
    fade_.active = false;
    set_color(color_of(step));
    return wait_ms(parameters_.sd2_ms);
  case MacroCommand::BackLed: host_->set_back_led(value[0]); return wait_ms(value[1]);
  case MacroCommand::RawMotors:
    host_->drive(Motors{motor(value[0], value[1]), motor(value[2], value[3])});
    return wait_ms(value[4]);
  case MacroCommand::Delay: return wait_ms(value[0]);
  case MacroCommand::Goto: return go_to(byte(value[0]));
  case MacroCommand::Gosub: return call(byte(value[0]));
  case MacroCommand::Sleep: finish(MacroEnding::Slept); return host_->sleep_ms(value[0]);
  case MacroCommand::SetSpd1: parameters_.spd1 = byte(value[0]); return;
  case MacroCommand::SetSpd2: parameters_.spd2 = byte(value[0]); return;
  case MacroCommand::RotationRate: return host_->drive(RotationRate{rate_deg_per_s(value[0])});
  case MacroCommand::Fade: return start_fade(color_of(step), value[3]);
  case MacroCommand::Marker: return host_->emit_marker(value[0], id_, number_);
  case MacroCommand::WaitUntilStopped:
    waits_for_stop_ = value[0] > 0 && !host_->stopped();
    return wait_ms(waits_for_stop_ ? value[0] : 0);
  case MacroCommand::Rotate: return rotate(value[0], value[1]);
  case MacroCommand::RotateSd1: return rotate(value[0], parameters_.sd1_ms);
  case MacroCommand::RotateSd2: return rotate(value[0], parameters_.sd2_ms);
  case MacroCommand::StreamEnd:
    return id_ == spec::macro_id_stream ? reach_end() : finish(MacroEnding::StreamEnd);
  case MacroCommand::LoopStart: return start_loop(byte(value[0]));
  case MacroCommand::LoopStartSystem: return start_loop(parameters_.system_loops);
  case MacroCommand::LoopEnd: return end_loop();
  case MacroCommand::Comment: return;
  case MacroCommand::OnCollision: collision_target_ = byte(value[0]); return;
  case MacroCommand::ConfigureCollision:
    return host_->configure_collisions(
        {value[0], value[1], value[2], value[3], value[4], value[5]});
  }
}

void MacroExecutive::wait_ms(std::int32_t time_ms) {
  wake_ = now_ + std::chrono::milliseconds(time_ms);
}

void MacroExecutive::roll(int speed, std::int32_t heading_deg) {
  if (now_ >= rotating_until_)
    host_->drive(
        Roll{heading_deg % spec::ball::full_circle, speed, speed == 0 ? Go::Brake : Go::Drive});
}

void MacroExecutive::rotate(std::int32_t angle_deg, std::int32_t time_ms) {
  const auto time = std::chrono::milliseconds(time_ms);
  rotating_until_ = now_ + time;
  host_->drive(Rotate{angle_deg, time});
}

void MacroExecutive::start_fade(Color to, std::int32_t time_ms) {
  fade_ = {time_ms > 0, color_, to, now_, std::chrono::milliseconds(time_ms)};
  if (!fade_.active)
    set_color(to);
}

void MacroExecutive::step_fade() {
  const auto elapsed = now_ - fade_.begin;
  if (elapsed >= fade_.time) {
    fade_.active = false;
    return set_color(fade_.to);
  }
  const Color color{blend(fade_.from.red, fade_.to.red, elapsed, fade_.time),
                    blend(fade_.from.green, fade_.to.green, elapsed, fade_.time),
                    blend(fade_.from.blue, fade_.to.blue, elapsed, fade_.time)};
  if (color != color_)
    set_color(color);
}

void MacroExecutive::set_color(Color color) {
  color_ = color;
  host_->set_led(color);
}

void MacroExecutive::start_loop(std::uint8_t count) {
  // Loops do not nest: a second Start replaces the first.
  loop_ = {id_, next_, number_, std::max(count, spec::macro_loop_least)};
}

void MacroExecutive::end_loop() {
  if (loop_.id != id_)
    return;
  if (--loop_.left == 0) {
    loop_ = {};
    return;
  }
  next_ = loop_.start;
  number_ = loop_.number;
}

void MacroExecutive::go_to(std::uint8_t id) {
  // The stream is not a target, not even for itself: its buffer has no fixed beginning.
  const auto image =
      id == spec::macro_id_stream || id == spec::macro_id_none ? ByteView{} : image_of(id);
  const auto header = protocol::read_macro_header(image);
  if (!header)
    return finish(MacroEnding::NoSuchMacro);
  if (inhibited(header->flags))
    return finish(MacroEnding::Inhibited);
  enter(id, header->flags, image.subspan(header->size));
}

void MacroExecutive::call(std::uint8_t id) {
  if (id_ == spec::macro_id_stream)
    return;
  const auto image =
      id == spec::macro_id_stream || id == spec::macro_id_none ? ByteView{} : image_of(id);
  const auto header = protocol::read_macro_header(image);
  if (!header)
    return finish(MacroEnding::NoSuchMacro);
  if (depth_ == stack_.size() || inhibited(header->flags))
    return;
  stack_[depth_++] = {id_, flags_, code_, next_, number_};
  enter(id, header->flags, image.subspan(header->size));
}

void MacroExecutive::reach_end() {
  if (has(MacroFlag::Endsig))
    host_->emit_marker(spec::macro_end_marker, id_, number_);
  if (depth_ == 0)
    return finish(MacroEnding::Ended);
  const auto& caller = stack_[--depth_];
  id_ = caller.id;
  flags_ = caller.flags;
  code_ = caller.code;
  next_ = caller.next;
  number_ = caller.number;
}

void MacroExecutive::finish(MacroEnding ending) {
  if (now_ < rotating_until_)
    host_->drive(Rotate{});
  if (has(MacroFlag::MotorControl))
    host_->drive(Stop{});
  rest(ending);
}

/// Ends the macro; nothing runs afterwards.
void MacroExecutive::rest(MacroEnding ending) {
  finished_ = {{id_, number_, ending}, flags_};
  id_ = spec::macro_id_none;
  flags_ = 0;
  depth_ = 0;
  wake_ = never;
  waits_for_stop_ = false;
  fade_.active = false;
  rotating_until_ = now_;
}

} // namespace orb::vm
