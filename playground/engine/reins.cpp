#include "playground/engine/reins.h"

#include <utility>

namespace orb::playground {

spec::Robot robot_named(std::string_view name) {
  return spec::robot_called(name).value_or(spec::Robot::Sphero);
}

/// The link between two messages: holds what arrived with the last one, and what to send with its
/// answer.
class Reins::Line final : public protocol::Transport {
public:
  void take(Done done) { in_ = std::move(done); }
  Bytes give() { return std::exchange(out_, {}); }

  Instant now() const override { return in_.at; }
  tl::expected<void, protocol::LinkError> write(ByteView bytes) override {
    if (in_.error)
      return tl::unexpected(*in_.error);
    out_.insert(out_.end(), bytes.begin(), bytes.end());
    return {};
  }
  tl::expected<Bytes, protocol::LinkError> read(Instant) override {
    if (in_.error)
      return tl::unexpected(*in_.error);
    return std::exchange(in_.bytes, {});
  }

private:
  Done in_;
  Bytes out_;
};

Reins::Reins(spec::Robot robot) : kind_(robot), line_(std::make_unique<Line>()) {}
/// Closes the link: the tether's destructor stops a robot that still drives, and would wait forever
/// for its answer.
Reins::~Reins() {
  line_->take(
      {now(), {}, protocol::LinkError{protocol::LinkError::Kind::Closed, "nobody is there"}});
}

tl::expected<std::optional<vm::Sample>, Failure> Reins::ready(const ordered_json& message) {
  if (message.contains("at"))
    log_.push_back(read_done(message));
  LogLink link(log_);
  auto robot = std::make_unique<run::Tether>(link, kind_, budgets_);
  auto first = robot->begin(run::Aim::Zero);
  wish_ = link.wish();
  if (!wish_.is_null())
    return std::nullopt;
  if (!first)
    return tl::unexpected(first.error());
  line_->take({link.now(), {}, {}});
  robot->relink(*line_);
  robot_ = std::move(robot);
  return *first;
}

void Reins::take(const ordered_json& message) {
  line_->take(read_done(message));
  if (!message.value("relinked", false))
    return;
  robot_->relink(*line_);
  if (ends_at_)
    ends_at_ = now() + budgets_.stop;
}

ordered_json Reins::give(double wait_ms) {
  ordered_json answer = {{"write", bytes_json(line_->give())}, {"wait_ms", wait_ms}};
  auto stop = robot_->stop_packets();
  if (stop != stop_)
    answer["stop"] = bytes_json(stop_ = std::move(stop));
  return answer;
}

Instant Reins::now() const {
  return line_->now();
}

void Reins::wind_up() {
  robot_->wind_up();
  ends_at_ = now() + budgets_.stop;
}

bool Reins::is_wound_up(const std::function<void(const run::RobotMessage&)>& hear) {
  return !robot_->pump(now(), hear) || robot_->is_wound_up() || now() >= *ends_at_;
}

} // namespace orb::playground
