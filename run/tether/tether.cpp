#include "run/tether/tether.h"

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
  if (const auto* motors = std::get_if<vm::Motors>(&motion)) {
    const auto drives = [](const vm::Motor& motor) {
      return motor.power != 0 &&
             (motor.mode == vm::MotorMode::Forward || motor.mode == vm::MotorMode::Reverse);
    };
    return drives(motors->left) || drives(motors->right);
  }
  return false;
}

} // namespace

Tether::Tether(protocol::Transport& transport, spec::Robot robot, const TetherBudgets& budgets,
               const Streamed& streamed)
    : transport_(&transport), robot_(robot), budgets_(budgets), wire_(make_wire(robot)),
      streamed_(streamed) {}

Tether::~Tether() {
  if (began_ && !finished_)
    finish();
}

Failure Tether::lost(const LinkError& error) const {
  if (error.kind == LinkError::Kind::Interrupted)
    return {ExitCode::Interrupted, "interrupted"};
  return {ExitCode::LinkLost, fmt::format("the link to the robot is lost: {}", error.message)};
}

// Requests.

tl::expected<void, LinkError> Tether::send(const Request& request, Kind kind) {
  constexpr std::size_t most_open = 64; // a robot that answers nothing
  const auto bytes = wire_->encode(request, seq_);
  open_.push_back({request, seq_, now(), kind});
  if (open_.size() > most_open)
    open_.pop_front();
  if (kind != Kind::Other)
    newest_[static_cast<std::size_t>(kind)] = seq_;
  seq_ = wire_->next_seq(seq_);
  next_send_ = now() + wire_->interval();
  return transport_->write(bytes);
}

/// Sends until it is answered. Samples that come are noted, and nothing else.
tl::expected<Bytes, Failure> Tether::ask(const Request& request, Duration budget) {
  const auto until = now() + budget;
  std::optional<std::uint8_t> refusal;
  while (now() < until) {
    const auto seq = seq_;
    if (auto sent = send(request, Kind::Other); !sent)
      return tl::unexpected(lost(sent.error()));
    const auto wait = std::min(until, now() + budgets_.answer);
    std::optional<Said::Answer> answer;
    while (!answer && now() < wait) {
      auto bytes = transport_->read(wait);
      if (!bytes)
        return tl::unexpected(lost(bytes.error()));
      wire_->feed(*bytes);
      while (const auto said = wire_->next()) {
        if (std::holds_alternative<vm::Sample>(said->what))
          sample_at_ = now();
        if (const auto* one = std::get_if<Said::Answer>(&said->what);
            one != nullptr && one->seq == seq)
          answer = *one;
      }
    }
    open_.clear();
    if (!answer)
      continue;
    if (answer->error == 0)
      return answer->data;
    refusal = answer->error;
    if (!wire_->means_later(answer->error))
      break;
    while (now() < wait) // it is busy
      if (auto bytes = transport_->read(wait); !bytes)
        return tl::unexpected(lost(bytes.error()));
      else
        wire_->feed(*bytes);
  }
  const auto what = fmt::format("{:02X}h {:02X}h", request.did, request.cid);
  if (refusal && request.need == Request::Need::Try)
    return Bytes{};
  if (refusal)
    return tl::unexpected(Failure{
        ExitCode::Refused, fmt::format("the robot refuses command {}: {}; charge it, put it on the "
                                       "floor, wake it, and try again",
                                       what, wire_->describe(*refusal))});
  return tl::unexpected(
      Failure{ExitCode::LinkLost,
              fmt::format("the robot does not answer command {}; wake it, bring it closer, or run "
                          "`orb doctor`",
                          what)});
}

tl::expected<vm::Sample, Failure> Tether::begin(Aim aim) {
  began_ = true;
  const auto fail = [&](Failure failure) {
    const bool stopped = finish();
    if (!stopped)
      failure.message += "; a stop was sent but not acknowledged";
    return tl::unexpected(std::move(failure));
  };
  const auto first = wire_->setup(aim);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto answer = ask(first[i], budgets_.setup);
    if (!answer)
      return fail(answer.error());
    wire_->hear_setup(i, *answer);
  }
  if (auto done = ask_all(wire_->setup_more()); !done)
    return fail(done.error());
  if (auto request = wire_->ask_battery()) {
    request->need = Request::Need::Try;
    const auto answer = ask(*request, budgets_.setup);
    if (!answer)
      return fail(answer.error());
    battery_ = wire_->read_battery(*answer);
    if (battery_)
      battery_at_ = now() + budgets_.battery;
  }
  auto sample = listen();
  return sample ? std::move(sample) : fail(sample.error());
}

tl::expected<void, Failure> Tether::ask_all(const std::vector<Request>& requests) {
  for (const auto& request : requests)
    if (const auto answer = ask(request, budgets_.setup); !answer)
      return tl::unexpected(answer.error());
  return {};
}

/// Lets the robot speak, and waits for what it says first.
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
  sample_at_ = now();
  stale_ = false;
  return *sample;
}

tl::expected<void, Failure> Tether::hold() {
  held_ = waits(Kind::Drive) ? std::exchange(waiting(Kind::Drive), std::nullopt) : driving_;
  if (waits(Kind::Stop))
    held_.reset();
  waiting(Kind::Stop).reset();
  driving_.reset();
  if (!brake({}))
    return tl::unexpected(Failure{ExitCode::LinkLost, std::string(stop_lost)});
  return ask_all(wire_->silence());
}

tl::expected<void, Failure> Tether::go_on() {
  if (auto heard = listen(); !heard)
    return tl::unexpected(heard.error());
  if (auto drive = std::exchange(held_, std::nullopt))
    waiting(Kind::Drive) = std::move(drive);
  return {};
}

// What the ball asks of its body.

void Tether::want_stop() {
  waiting(Kind::Stop) = wire_->brake(heading_);
  waiting(Kind::Drive).reset();
  driving_.reset();
}

void Tether::obey(const vm::Motion& motion) {
  if (std::holds_alternative<vm::Stop>(motion))
    return want_stop();
  if (const auto* turn = std::get_if<vm::Rotate>(&motion)) {
    // It has no such command: it turns to where the turn ends.
    constexpr int circle = 360;
    heading_ = ((heading_ + turn->angle_deg) % circle + circle) % circle;
    waiting(Kind::Drive) = wire_->drive(vm::Roll{heading_, 0, vm::Go::Drive});
    return;
  }
  auto request = wire_->drive(motion);
  if (!request)
    return;
  if (std::holds_alternative<vm::Stabilization>(motion)) {
    waiting(Kind::Stabilization) = std::move(request);
    return;
  }
  if (std::holds_alternative<vm::RotationRate>(motion)) {
    waiting(Kind::Rate) = std::move(request);
    return;
  }
  const auto* roll = std::get_if<vm::Roll>(&motion);
  if (roll != nullptr)
    heading_ = roll->heading_deg;
  const bool brakes = roll != nullptr && roll->go == vm::Go::Brake;
  const bool was_driving = driving_.has_value() || waits(Kind::Drive);
  if (brakes || (was_driving && !is_driving(motion)))
    return want_stop();
  waiting(Kind::Drive) = std::move(request);
}

void Tether::show(vm::Color color) {
  const auto all = wire_->show(color);
  waiting(Kind::Lamp) = all.front();
  if (all.size() > 1)
    waiting(Kind::Matrix) = all.back();
}

void Tether::show_back(int level) {
  waiting(Kind::BackLamp) = wire_->show_back(level);
}

// Sending.

Instant Tether::next_due() const {
  Instant due = never;
  for (std::size_t kind = 0; kind < kinds; ++kind)
    if (waiting_[kind] && may_leave(static_cast<Kind>(kind)))
      due = next_send_;
  if (stopped_ && !parting_.empty())
    due = std::min(due, next_send_);
  if (battery_at_)
    due = std::min(due, std::max(next_send_, *battery_at_));
  if (driving_ && !stale_)
    due = std::min(due, std::max(next_send_, driven_at_ + budgets_.repeat));
  if (!open_.empty())
    due = std::min(due, open_.front().sent + budgets_.answer);
  return due;
}

/// What the robot has not taken is sent again, unless there is something newer of its kind.
void Tether::send_again(const Pending& pending) {
  if (pending.kind == Kind::Other || waits(pending.kind) ||
      newest_[static_cast<std::size_t>(pending.kind)] != pending.seq)
    return;
  const bool outdated = pending.kind == Kind::Stop    ? driving_.has_value()
                        : pending.kind == Kind::Drive ? waits(Kind::Stop) || !driving_
                                                      : false;
  if (!outdated)
    waiting(pending.kind) = pending.request;
}

void Tether::give_up_waiting() {
  while (!open_.empty() && now() >= open_.front().sent + budgets_.answer) {
    const auto pending = std::move(open_.front());
    open_.pop_front();
    send_again(pending);
  }
}

/// Sends the most urgent one of what waits, where the robot can take another command.
tl::expected<void, LinkError> Tether::send_due() {
  give_up_waiting();
  if (now() < next_send_)
    return {};
  if (battery_at_ && now() >= *battery_at_) {
    battery_at_ = now() + budgets_.battery;
    waiting(Kind::Battery) = wire_->ask_battery();
  }
  for (std::size_t i = 0; i < kinds; ++i) {
    const auto kind = static_cast<Kind>(i);
    if (!waits(kind) || !may_leave(kind))
      continue;
    const auto request = *std::exchange(waiting(kind), std::nullopt);
    if (kind == Kind::Drive) {
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
  return {};
}

/// What an answer means for what was asked; the voltage of the battery where that was it.
std::optional<vm::stimulus::Battery> Tether::take(const Said::Answer& answer) {
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const Pending& one) { return one.seq == answer.seq; });
  if (found == open_.end())
    return std::nullopt;
  const auto pending = std::move(*found);
  open_.erase(found);
  if (answer.error == 0) {
    busy_since_.reset();
    stopped_ = stopped_ || (winding_up_ && pending.kind == Kind::Stop);
    return pending.kind == Kind::Battery ? wire_->read_battery(answer.data) : std::nullopt;
  }
  if (pending.kind == Kind::Battery)
    return std::nullopt; // it is asked again later
  const bool later = wire_->means_later(answer.error);
  if (later) {
    busy_since_ = busy_since_.value_or(now());
    send_again(pending);
  }
  const bool for_long = busy_since_ && now() - *busy_since_ >= budgets_.busy;
  if (!refused_ && (for_long || !later))
    refused_ =
        Failure{ExitCode::Refused,
                fmt::format("the robot refuses command {:02X}h {:02X}h: {}", pending.request.did,
                            pending.request.cid, wire_->describe(answer.error))};
  return std::nullopt;
}

/// Without samples nobody knows where it is: it stops, and goes on when they come again.
void Tether::watch_samples() {
  if (stale_ || sample_age() < budgets_.stale)
    return;
  stale_ = true;
  const auto again = waits(Kind::Drive) ? waiting(Kind::Drive) : driving_;
  want_stop();
  waiting(Kind::Drive) = again; // leaves when samples come again
}

tl::expected<void, Failure> Tether::pump(Instant deadline,
                                         const std::function<void(const Said&)>& hear) {
  if (auto sent = send_due(); !sent)
    return tl::unexpected(lost(sent.error()));
  const auto wait = std::min(
      {deadline, std::max(now(), next_due()), stale_ ? never : sample_at_ + budgets_.stale});
  auto bytes = transport_->read(wait);
  if (!bytes)
    return tl::unexpected(lost(bytes.error()));
  wire_->feed(*bytes);
  while (const auto said = wire_->next()) {
    if (std::holds_alternative<vm::Sample>(said->what)) {
      sample_at_ = now();
      stale_ = false;
    }
    const auto* answer = std::get_if<Said::Answer>(&said->what);
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
  finished_ = true; // it is not told to stop once more when it is left
  winding_up_ = true;
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
}

/// Sends the brake until it is acknowledged, or the link is lost.
bool Tether::brake(const std::function<void(const Said&)>& hear) {
  const auto until = now() + budgets_.stop;
  while (now() < until) {
    const auto seq = seq_;
    // An interruption is noticed once; what follows goes through.
    if (auto sent = send(wire_->brake(heading_), Kind::Stop); !sent) {
      if (sent.error().kind != LinkError::Kind::Interrupted)
        return false;
      continue;
    }
    const auto wait = std::min(until, now() + budgets_.answer);
    while (now() < wait) {
      auto bytes = transport_->read(wait);
      if (!bytes) {
        if (bytes.error().kind != LinkError::Kind::Interrupted)
          return false;
        continue;
      }
      wire_->feed(*bytes);
      while (const auto said = wire_->next()) {
        if (const auto* answer = std::get_if<Said::Answer>(&said->what)) {
          if (answer->seq == seq && answer->error == 0)
            return true;
        } else if (hear)
          hear(*said);
      }
    }
  }
  return false;
}

/// Where it came to is what it says once it rests.
void Tether::await_rest(const std::function<void(const Said&)>& hear) {
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
      if (hear && !std::holds_alternative<Said::Answer>(said->what))
        hear(*said);
    }
  }
}

bool Tether::finish(const std::function<void(const Said&)>& hear) {
  finished_ = true;
  if (!brake(hear))
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
