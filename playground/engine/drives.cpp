#include "playground/engine/drives.h"

#include "spec/ble.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {
namespace {

/// The robot whose name that is; a classic ball where there is none, as over a serial port.
spec::Robot robot_named(std::string_view name) {
  for (const auto& row : spec::robots)
    if (row.robot != spec::Robot::Sphero && name.starts_with(spec::info(row.ble).prefix))
      return row.robot;
  return spec::Robot::Sphero;
}

} // namespace

/// The link between two messages: what came with the last one, and what goes out with its answer.
class Drive::Line final : public protocol::Transport {
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

Drive::Drive(const Request& request)
    : said_(request.said), request_(request.params), line_(std::make_unique<Line>()) {}
Drive::~Drive() = default;

tl::expected<std::unique_ptr<Drive>, Problem> Drive::start(Request& request) {
  // What cannot run is told before a robot is asked for anything.
  if (const auto runs = Run::start(request, {}); !runs)
    return tl::unexpected(runs.error());
  std::unique_ptr<Drive> drive(new Drive(request));
  drive->options_.robot = robot_named(request.text("robot"));
  return drive;
}

Answer Drive::step(const ordered_json& message) {
  return ends_at_ ? wind_up(message) : robot_ ? drive(message) : ready(message);
}

Answer Drive::ready(const ordered_json& message) {
  if (message.contains("at"))
    log_.push_back(read_done(message));
  LogLink link(log_);
  auto robot = std::make_unique<run::Tether>(link, options_.robot, options_.budgets);
  const auto first = robot->begin(options_.aim);
  if (!link.wish().is_null())
    return print({{"wish", link.wish()}});
  if (!first)
    return refuse(first.error());
  line_->take({link.now(), {}, {}});
  robot->relink(*line_);
  robot_ = std::move(robot);
  Request request(request_, said_);
  auto run = Run::start(request, {std::nullopt, true}, robot_.get(), *first);
  if (!run)
    return tl::unexpected(run.error());
  run_ = *std::move(run);
  run_->keep_waiting();
  driven_ = std::make_unique<run::Driven>(run_->live(), *robot_, run_->listener(), options_);
  return fmt::format(R"({{"robot":{},"report":{}}})",
                     print(ordered_json(spec::info(options_.robot).title)), run_->report_so_far());
}

Answer Drive::drive(const ordered_json& message) {
  line_->take(read_done(message));
  bool ends = message.value("stop", false);
  // Once for what has come, and once more for what the program makes of it.
  for (int i = 0; i < 2 && !ends; ++i) {
    const auto course = driven_->step();
    if (!course)
      trouble_ = course.error().message;
    else
      has_ended_ = *course == run::Driven::Course::Ends;
    ends = course != run::Driven::Course::GoesOn;
  }
  if (ends) {
    driven_->end();
    robot_->wind_up();
    ends_at_ = line_->now() + options_.budgets.stop;
    return wind_up({{"at", message.at("at")}});
  }
  return go_on(message, milliseconds(driven_->nap()));
}

Answer Drive::go_on(const ordered_json& message, double wait_ms) {
  return fmt::format(R"({{"write":{},"wait_ms":{}{}}})", print(bytes_json(line_->give())),
                     print(ordered_json(wait_ms)),
                     message.value("frame", false) ? ",\"frame\":" + run_->frame() : std::string());
}

Answer Drive::wind_up(const ordered_json& message) {
  line_->take(read_done(message));
  const auto pumped = robot_->pump(line_->now(), driven_->hear());
  if (!pumped || robot_->is_wound_up() || line_->now() >= *ends_at_)
    return over();
  constexpr double often_ms = 5;
  return go_on(message, often_ms);
}

Answer Drive::over() {
  const bool stopped = robot_->acknowledged();
  if (!has_ended_)
    run_->stop();
  const auto answer = run_->answer();
  if (!answer)
    return answer;
  return fmt::format(R"({{"over":{},"write":{},"stopped":{},"trouble":{}}})", *answer,
                     print(bytes_json(line_->give())), stopped, print(ordered_json(trouble_)));
}

} // namespace orb::playground
