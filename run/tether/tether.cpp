#include "run/tether/tether.h"

#include "base/contain.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

using protocol::LinkError;

bool is_driving(const vm::Motion& motion) {
  if (const auto* roll = std::get_if<vm::Roll>(&motion))
    return roll->speed != 0 && roll->go != vm::Go::Brake;
  return false;
}

/// A wait that overruns by more than this is a computer that slept, not a slow link.
constexpr Duration longest_wait = 200ms;

} // namespace

Tether::Tether(protocol::Transport& transport, spec::Robot robot, const TetherBudgets& budgets,
               const Streamed& streamed, Reopen reopen)
    : reopen_(std::move(reopen)), transport_(&transport), robot_(robot), budgets_(budgets),
      wire_(make_wire(robot, budgets.collisions)), streamed_(streamed),
      looked_at_(transport.now()) {}

Tether::~Tether() {
  if (began_ && !finished_) // a destructor must not throw and has nobody to report to
    static_cast<void>(contain([this]() -> tl::expected<void, Failure> {
      finish();
      return {};
    }));
}

Failure Tether::lost(const LinkError& error) const {
  if (error.kind == LinkError::Kind::Interrupted)
    return {ExitCode::Interrupted, "interrupted"};
  return {ExitCode::LinkLost, fmt::format("the link to the robot is lost: {}", error.message)};
}

// Requests.

tl::expected<void, LinkError> Tether::send(const Request& request, Kind kind) {
  constexpr std::size_t most_open = 64; // limit for a robot that never answers
  const auto bytes = wire_->encode(request, seq_);
  open_.push_back({request, seq_, now(), kind});
  if (open_.size() > most_open)
    open_.pop_front();
  if (kind != Kind::Other)
    newest_[static_cast<std::size_t>(kind)] = seq_;
  seq_ = wire_->next_seq(seq_);
  next_send_ = now() + wire_->interval();
  loose_ = loose_ || wire_->loosens(request);
  return transport_->write(bytes);
}

/// Sends a request until it is answered. Meanwhile only the arrival of samples is noted.
tl::expected<std::optional<Bytes>, Failure> Tether::ask(const Request& request, Duration budget) {
  const auto until = now() + budget;
  std::optional<std::uint8_t> refusal;
  while (now() < until) {
    const auto seq = seq_;
    if (auto sent = send(request, Kind::Other); !sent)
      return tl::unexpected(lost(sent.error()));
    const auto wait = std::min(until, now() + budgets_.answer);
    std::optional<RobotMessage::Answer> answer;
    while (!answer && now() < wait) {
      auto bytes = transport_->read(wait);
      if (!bytes)
        return tl::unexpected(lost(bytes.error()));
      wire_->feed(*bytes);
      while (const auto said = wire_->next()) {
        if (std::holds_alternative<vm::Sample>(said->what))
          sample_at_ = now();
        if (const auto* one = std::get_if<RobotMessage::Answer>(&said->what);
            one != nullptr && one->seq == seq)
          answer = *one;
      }
    }
    for (const auto& one : std::exchange(open_, {}))
      if (one.kind != Kind::Drive && one.kind != Kind::Stabilization)
        send_again(one); // for example a lamp: sent once the run continues
    if (!answer)
      continue;
    if (answer->error == 0)
      return std::optional(std::move(answer->data));
    refusal = answer->error;
    if (!wire_->means_later(answer->error))
      break;
    while (now() < wait) // the robot is busy
      if (auto bytes = transport_->read(wait); !bytes)
        return tl::unexpected(lost(bytes.error()));
      else
        wire_->feed(*bytes);
  }
  if (refusal && request.need == Request::Need::Try)
    return std::nullopt;
  if (refusal)
    return tl::unexpected(this->refusal(request, *refusal));
  return tl::unexpected(
      Failure{ExitCode::LinkLost,
              fmt::format("the robot does not answer {}; wake it, bring it closer, or run "
                          "`orb doctor`",
                          wire_->name_of(request))});
}

tl::expected<vm::Sample, Failure> Tether::begin(Aim aim) {
  began_ = true;
  const auto fail = [&](Failure failure) {
    const bool stopped = finish_here({}); // it has not been driven, so a lost link stays lost
    if (!stopped)
      failure.message += "; a stop was sent but not acknowledged";
    return tl::unexpected(std::move(failure));
  };
  const auto first = wire_->setup(aim);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto answer = ask(first[i], budgets_.setup);
    if (!answer)
      return fail(answer.error());
    wire_->hear_setup(first[i], *answer);
    for (const auto until = now() + wire_->rests_after(first[i]); now() < until;)
      if (const auto bytes = transport_->read(until); !bytes)
        return fail(lost(bytes.error()));
      else
        wire_->feed(*bytes);
  }
  if (auto done = ask_all(wire_->setup_more()); !done)
    return fail(done.error());
  auto battery = wire_->ask_battery();
  battery.need = Request::Need::Try;
  const auto answer = ask(battery, budgets_.setup);
  if (!answer)
    return fail(answer.error());
  battery_ = wire_->read_battery(answer->value_or(Bytes{}));
  battery_at_ = now() + budgets_.battery;
  auto sample = listen();
  return sample ? std::move(sample) : fail(sample.error());
}

tl::expected<void, Failure> Tether::ask_all(const std::vector<Request>& requests) {
  for (const auto& request : requests)
    if (const auto answer = ask(request, budgets_.setup); !answer)
      return tl::unexpected(answer.error());
  return {};
}

/// Starts streaming and waits for the first sample.
tl::expected<vm::Sample, Failure> Tether::listen() {
  if (auto asked = ask_all(wire_->stream(streamed_)); !asked)
    return tl::unexpected(asked.error());
  std::optional<vm::Sample> sample;
  const auto until = now() + budgets_.first_sample;
  while (!sample && now() < until) {
    auto bytes = transport_->read(until);
    if (!bytes)
      return tl::unexpected(lost(bytes.error()));
    wire_->feed(*bytes);
    while (const auto said = wire_->next())
      if (const auto* felt = std::get_if<vm::Sample>(&said->what))
        sample = *felt;
  }
  if (!sample)
    return tl::unexpected(
        Failure{ExitCode::LinkLost,
                fmt::format("the robot answers, but no sensor data came for {} s; is it a {}? "
                            "if not, name it with `--robot`",
                            budgets_.first_sample / 1s, spec::info(robot_).title)});
  sample_at_ = looked_at_ = now();
  facing_deg_ = vm::whole_heading(sample->yaw_deg);
  stale_ = false;
  return *sample;
}

tl::expected<void, Failure> Tether::hold() {
  held_ = waits(Kind::Drive) ? std::exchange(waiting(Kind::Drive), std::nullopt) : driving_;
  driving_.reset();
  if (!brake({}))
    return tl::unexpected(refused_.value_or(Failure{ExitCode::LinkLost, std::string(stop_lost)}));
  return ask_all(wire_->silence());
}

tl::expected<void, Failure> Tether::go_on() {
  if (auto heard = listen(); !heard)
    return tl::unexpected(heard.error());
  resume(std::exchange(held_, std::nullopt));
  return {};
}

// Requests of the ball.

/// Depends on what drives the motors: a robot without stabilization ignores a roll.
std::deque<Request> Tether::stop_steps() {
  std::deque<Request> steps;
  if (loose_) {
    heading_ = facing_deg_; // raw motors may have turned it
    steps.push_back(*wire_->drive(vm::Motors{}));
    if (auto on = wire_->drive(vm::Stabilization::On))
      steps.push_back(*std::move(on));
  }
  steps.push_back(wire_->brake(heading_));
  return steps;
}

Bytes Tether::stop_packets() {
  Bytes packets;
  for (const auto& step : stop_steps()) {
    const auto packet =
        wire_->encode(step, 0); // a fixed number, so that equal steps give equal bytes
    packets.insert(packets.end(), packet.begin(), packet.end());
  }
  return packets;
}

void Tether::begin_stop(std::deque<Request> steps) {
  stopping_ = std::move(steps);
  stop_open_ = false;
  stops_whole_ = true;
}

void Tether::want_stop() {
  auto steps = stop_steps();
  if (!stopping_.empty() && stops_whole_) { // in progress: restarting each time would never end
    if (!loose_ && stopping_.back().data != steps.back().data) {
      stopping_.back() = steps.back();
      stop_open_ = false;
    }
  } else
    begin_stop(std::move(steps));
  // Drop unacknowledged drive requests, so that they are not repeated after the stop.
  std::erase_if(open_, [](const Pending& one) {
    return one.kind == Kind::Stabilization || one.kind == Kind::Drive;
  });
  waiting(Kind::Drive).reset();
  waiting(Kind::Stabilization).reset();
  driving_.reset();
}

/// Restores what the program wants after a stop that it did not order.
void Tether::resume(std::optional<Request> drive) {
  if (drive)
    waiting(Kind::Drive) = std::move(drive);
  else if (!stabilized_)
    waiting(Kind::Stabilization) = wire_->drive(vm::Stabilization::Off);
}

void Tether::drive_motors(vm::Motors motors) {
  for (auto [motor, before] :
       {std::pair{&motors.left, &motors_.left}, std::pair{&motors.right, &motors_.right}})
    if (motor->mode == vm::MotorMode::Ignore)
      *motor = *before;
  motors_ = motors;
  stabilized_ = false;
  auto request = *wire_->drive(motors);
  if (is_on(motors.left) || is_on(motors.right)) {
    waiting(Kind::Drive) = std::move(request);
    return;
  }
  want_stop();
  begin_stop({std::move(request)});
  stops_whole_ = false; // nothing else: unpowered it coasts
}

void Tether::obey(const vm::Motion& motion) {
  if (std::holds_alternative<vm::Stop>(motion)) {
    motors_ = {};
    return want_stop();
  }
  if (const auto* motors = std::get_if<vm::Motors>(&motion))
    return drive_motors(*motors);
  if (const auto* turn = std::get_if<vm::Rotate>(&motion)) {
    // The robot has no turn command: order the final heading.
    heading_ = vm::whole_heading(heading_ + turn->angle_deg);
    waiting(Kind::Drive) = wire_->drive(vm::Roll{heading_, 0, vm::Go::Drive});
    return;
  }
  if (const auto* mode = std::get_if<vm::Stabilization>(&motion)) {
    const bool was_stabilized = std::exchange(stabilized_, *mode != vm::Stabilization::Off);
    if (stabilized_)
      motors_ = {};
    if (stabilized_ && (loose_ || !was_stabilized))
      return want_stop();
    if (was_stabilized == stabilized_ && *mode != vm::Stabilization::OnAndReset)
      return;                             // repeating it would starve other requests
    if (was_stabilized && !stabilized_) { // it rolls on unpowered
      waiting(Kind::Drive).reset();
      driving_.reset();
    }
    waiting(Kind::Stabilization) = wire_->drive(motion);
    return;
  }
  auto request = wire_->drive(motion);
  if (!request)
    return;
  const auto* roll = std::get_if<vm::Roll>(&motion);
  if (roll == nullptr) {
    waiting(Kind::Rate) = std::move(request);
    return;
  }
  heading_ = roll->heading_deg;
  const bool was_driving = driving_.has_value() || waits(Kind::Drive);
  if (roll->go == vm::Go::Brake || (was_driving && !is_driving(motion)))
    return want_stop();
  waiting(Kind::Drive) = std::move(request);
}

void Tether::show(vm::Color color) {
  soon_.clear();
  const auto all = wire_->show(color);
  waiting(Kind::Lamp) = all.front();
  if (all.size() > 1)
    waiting(Kind::Matrix) = all.back();
}

void Tether::show_back(int level) {
  waiting(Kind::BackLamp) = wire_->show_back(level);
}

// Sending.

/// Drive requests wait for the stop before them and for samples. They may replace the last step of
/// a stop once that has been sent.
bool Tether::may_leave(Kind kind) const {
  if (kind == Kind::Stabilization)
    return stopping_.empty() && !stale_;
  return kind != Kind::Drive ||
         (!stale_ && (stopping_.empty() || (stopping_.size() == 1 && stop_open_ && !loose_)));
}

bool Tether::is_idle() const {
  return soon_.empty() && stopping_.empty() &&
         std::none_of(waiting_.begin(), waiting_.end(),
                      [](const auto& request) { return request.has_value(); });
}

Instant Tether::next_due() const {
  Instant due = !stopping_.empty() && !stop_open_ ? next_send_ : never;
  for (std::size_t kind = 0; kind < kinds; ++kind)
    if (waiting_[kind] && may_leave(static_cast<Kind>(kind)))
      due = next_send_;
  if ((stopped_ && !parting_.empty()) || !soon_.empty())
    due = std::min(due, next_send_);
  if (battery_at_)
    due = std::min(due, std::max(next_send_, *battery_at_));
  if (driving_ && !stale_)
    due = std::min(due, std::max(next_send_, driven_at_ + budgets_.repeat));
  if (!open_.empty())
    due = std::min(due, open_.front().sent + budgets_.answer);
  return due;
}

/// Repeats a request that the robot did not take, unless a newer one of its kind exists.
void Tether::send_again(const Pending& pending) {
  if (pending.kind == Kind::Other || waits(pending.kind) ||
      newest_[static_cast<std::size_t>(pending.kind)] != pending.seq)
    return;
  if (pending.kind == Kind::Stop)
    stop_open_ = false;
  else if (pending.kind != Kind::Drive || driving_)
    waiting(pending.kind) = pending.request;
}

void Tether::give_up_waiting() {
  while (!open_.empty() && now() >= open_.front().sent + budgets_.answer) {
    const auto pending = std::move(open_.front());
    open_.pop_front();
    send_again(pending);
  }
}

/// Sends the most urgent waiting request, if the robot can take another command.
tl::expected<void, LinkError> Tether::send_due() {
  give_up_waiting();
  if (now() < next_send_)
    return {};
  if (battery_at_ && now() >= *battery_at_) {
    battery_at_ = now() + budgets_.battery;
    waiting(Kind::Battery) = wire_->ask_battery();
  }
  if (!stopping_.empty() && !stop_open_) {
    stop_open_ = true;
    return send(stopping_.front(), Kind::Stop);
  }
  for (std::size_t i = 0; i < kinds; ++i) {
    const auto kind = static_cast<Kind>(i);
    if (!waits(kind) || !may_leave(kind))
      continue;
    const auto request = *std::exchange(waiting(kind), std::nullopt);
    if (kind == Kind::Drive) {
      stopping_.clear();
      driving_ = request;
      driven_at_ = now();
    }
    return send(request, kind);
  }
  if (stopped_ && !parting_.empty()) {
    const auto request = parting_.front();
    parting_.pop_front();
    return send(request, Kind::Other);
  }
  if (driving_ && !stale_ && now() >= driven_at_ + budgets_.repeat) {
    driven_at_ = now();
    return send(*driving_, Kind::Drive);
  }
  if (!soon_.empty()) {
    const auto request = soon_.front();
    soon_.pop_front();
    return send(request, Kind::Other);
  }
  return {};
}

/// After a whole stop a roll of speed 0 is enough to stop again.
void Tether::stop_acknowledged() {
  stopped_ = winding_up_;
  loose_ = false;
  refused_.reset();
}

/// Handles an answer. Returns the battery voltage if that was the question.
std::optional<vm::stimulus::Battery> Tether::take(const RobotMessage::Answer& answer) {
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const Pending& one) { return one.seq == answer.seq; });
  if (found == open_.end())
    return std::nullopt;
  const auto pending = std::move(*found);
  open_.erase(found);
  if (pending.kind == Kind::Other)
    return std::nullopt;
  auto& busy = busy_[static_cast<std::size_t>(pending.kind)];
  const bool later = wire_->means_later(answer.error);
  if (answer.error != 0 && pending.kind == Kind::Battery)
    return std::nullopt; // asked again later
  if (later) {
    if (!busy || now() - busy->last > 2 * budgets_.answer)
      busy = Busy{now(), now()};
    busy->last = now();
    send_again(pending);
    if (!refused_ && now() - busy->since >= budgets_.busy)
      refused_ = refusal(pending.request, answer.error);
    return std::nullopt;
  }
  const bool done = answer.error == 0 || pending.request.need == Request::Need::Try;
  if (!done && !refused_)
    refused_ = refusal(pending.request, answer.error);
  if (pending.kind == Kind::Stop)
    take_step(pending, done);
  if (!done)
    return std::nullopt;
  busy.reset();
  has_driven_ = has_driven_ || pending.kind == Kind::Drive;
  return pending.kind == Kind::Battery ? wire_->read_battery(answer.data) : std::nullopt;
}

/// A step of a stop was answered; the next one follows even after a refusal.
void Tether::take_step(const Pending& step, bool done) {
  if (stopping_.empty() || newest_[static_cast<std::size_t>(Kind::Stop)] != step.seq)
    return;
  stopping_.pop_front();
  stop_open_ = false;
  stops_whole_ = stops_whole_ && done;
  if (stopping_.empty() && stops_whole_)
    stop_acknowledged();
}

Failure Tether::refusal(const Request& request, std::uint8_t error) const {
  const auto remedy = wire_->means_later(error)
                          ? "wait until it has done what it does, or switch it off and on"
                          : "charge it, put it on the floor, wake it, and try again";
  return {ExitCode::Refused, fmt::format("the robot refuses {}: {}; {}", wire_->name_of(request),
                                         wire_->describe(error), remedy)};
}

std::optional<Failure> Tether::verdict() const {
  if (refused_)
    return refused_;
  if (!has_driven_ && busy_[static_cast<std::size_t>(Kind::Drive)])
    return Failure{ExitCode::Refused,
                   "the robot was busy and took no command that drives it; wait until it has done "
                   "what it does, or switch it off and on"};
  return std::nullopt;
}

/// Without samples the place is unknown: stops the robot until they come again.
void Tether::watch_samples() {
  if (stale_ || sample_age() < budgets_.stale)
    return;
  stale_ = true;
  auto again = waits(Kind::Drive) ? waiting(Kind::Drive) : driving_;
  want_stop();
  resume(std::move(again)); // sent when samples come again
}

Duration Tether::slept_since(Instant expected) const {
  const auto late = now() - std::max(expected, looked_at_);
  return late > longest_wait ? late : Duration{};
}

/// A write over Bluetooth LE takes time, in which the robot drives unheard; only a very long one
/// counts as a pause.
void Tether::notice_slow_write() {
  constexpr Duration longest_write = 1500ms;
  const auto took = now() - looked_at_;
  if (took > longest_write)
    slept_ += took;
  looked_at_ = now();
}

void Tether::notice_pause(Instant expected) {
  const auto slept = slept_since(expected);
  slept_ += slept;
  sample_at_ = std::min(now(), sample_at_ + slept); // none could be received meanwhile
  looked_at_ = now();
}

tl::expected<void, Failure> Tether::pump(Instant deadline,
                                         const std::function<void(const RobotMessage&)>& hear) {
  notice_pause(looked_at_);
  if (auto sent = send_due(); !sent)
    return tl::unexpected(lost(sent.error()));
  notice_slow_write();
  const auto wait = std::min(
      {deadline, std::max(now(), next_due()), stale_ ? never : sample_at_ + budgets_.stale});
  auto bytes = transport_->read(wait);
  if (!bytes)
    return tl::unexpected(lost(bytes.error()));
  notice_pause(wait);
  wire_->feed(*bytes);
  while (const auto said = wire_->next()) {
    if (const auto* sample = std::get_if<vm::Sample>(&said->what)) {
      sample_at_ = now();
      facing_deg_ = vm::whole_heading(sample->yaw_deg);
      stale_ = false;
    }
    if (std::holds_alternative<RobotMessage::WillSleep>(said->what))
      battery_at_ = now(); // any request keeps it awake
    const auto* answer = std::get_if<RobotMessage::Answer>(&said->what);
    if (answer == nullptr)
      hear(*said);
    else if (const auto battery = take(*answer))
      hear({*battery});
  }
  if (winding_up_)
    return {};
  watch_samples();
  if (refused_)
    return tl::unexpected(*refused_);
  if (sample_age() >= budgets_.gone)
    return tl::unexpected(Failure{
        ExitCode::LinkLost,
        fmt::format("no sensor data came for {} s; bring the robot closer", budgets_.gone / 1s)});
  return {};
}

void Tether::wind_up() {
  finished_ = true; // the destructor need not stop it again
  winding_up_ = true;
  soon_.clear();
  stale_ = false;
  battery_at_.reset();
  want_stop();
  for (const auto& requests : {wire_->silence(), wire_->teardown()})
    parting_.insert(parting_.end(), requests.begin(), requests.end());
}

void Tether::relink(protocol::Transport& transport) {
  transport_ = &transport;
  wire_->feed({});
  open_.clear();
  stop_open_ = false;
  link_lost_ = false;
}

/// Sends the request at least once, until it is acknowledged, `until` passes or the link is lost.
bool Tether::acknowledges(const Request& request, Instant until,
                          const std::function<void(const RobotMessage&)>& hear) {
  do {
    const auto seq = seq_;
    // Retry after an interruption, which occurs once; later writes succeed.
    if (auto sent = send(request, Kind::Stop); !sent) {
      if (sent.error().kind == LinkError::Kind::Interrupted)
        continue;
      link_lost_ = true;
      return false;
    }
    const auto wait = std::min(until, now() + budgets_.answer);
    while (now() < wait) {
      auto bytes = transport_->read(wait);
      if (!bytes) {
        if (bytes.error().kind == LinkError::Kind::Interrupted)
          continue;
        link_lost_ = true;
        return false;
      }
      wire_->feed(*bytes);
      while (const auto said = wire_->next()) {
        const auto* answer = std::get_if<RobotMessage::Answer>(&said->what);
        if (answer == nullptr && hear)
          hear(*said);
        if (answer == nullptr || answer->seq != seq)
          continue;
        const bool later = wire_->means_later(answer->error);
        if (answer->error == 0 || (!later && request.need == Request::Need::Try))
          return true;
        refused_ = refusal(request, answer->error);
        if (!later)
          return false;
      }
    }
  } while (now() < until);
  return false;
}

/// Stops the robot step by step. A step without acknowledgement does not prevent the next ones.
bool Tether::brake(const std::function<void(const RobotMessage&)>& hear) {
  const auto steps = stop_steps();
  stopping_.clear();
  const auto until = now() + budgets_.stop;
  bool all = true;
  for (const auto& step : steps)
    all = acknowledges(step, until, hear) && all;
  if (all)
    stop_acknowledged();
  return all;
}

/// Waits until the robot rests, so that its final place is known.
void Tether::await_rest(const std::function<void(const RobotMessage&)>& hear) {
  constexpr double crawl_cm_s = 1;
  const auto until = now() + budgets_.rest;
  for (bool moves = true; moves && now() < until;) {
    auto bytes = transport_->read(until);
    if (!bytes)
      return;
    wire_->feed(*bytes);
    while (const auto said = wire_->next()) {
      if (const auto* sample = std::get_if<vm::Sample>(&said->what))
        moves = std::hypot(sample->velocity_cm_s.x, sample->velocity_cm_s.y) > crawl_cm_s;
      if (hear && !std::holds_alternative<RobotMessage::Answer>(said->what))
        hear(*said);
    }
  }
}

bool Tether::finish(const std::function<void(const RobotMessage&)>& hear) {
  bool stopped = finish_here(hear);
  for (bool lost = link_lost_ || sample_age() >= budgets_.gone; !stopped && lost && reopen_;
       lost = link_lost_) {
    auto next = reopen_();
    if (next == nullptr)
      break;
    relink(*next);
    again_ = std::move(next);
    stopped = finish_here({});
  }
  return stopped;
}

/// As finish(), over the present link.
bool Tether::finish_here(const std::function<void(const RobotMessage&)>& hear) {
  const bool braked = brake(hear);
  finished_ = true; // not earlier: `hear` may throw
  if (!braked)
    return false;
  if (hear)
    await_rest(hear);
  for (const auto& requests : {wire_->silence(), wire_->teardown()})
    for (const auto& request : requests)
      if (const auto done = ask(request, budgets_.teardown);
          !done && done.error().code == ExitCode::Interrupted)
        return true;
  return true;
}

} // namespace orb::run
