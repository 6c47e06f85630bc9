#include "playground/engine/drives.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {

Drive::Drive(const Request& request)
    : said_(request.said), request_(request.params), reins_(robot_named(request.text("robot"))) {
  options_.robot = robot_named(request.text("robot"));
}

tl::expected<std::unique_ptr<Drive>, Problem> Drive::start(Request& request) {
  // Report a program that cannot run before asking a robot for anything.
  if (const auto runs = Run::start(request, {}); !runs)
    return tl::unexpected(runs.error());
  return std::unique_ptr<Drive>(new Drive(request));
}

Answer Drive::step(const ordered_json& message) {
  if (!reins_.is_ready())
    return ready(message);
  reins_.take(message);
  return reins_.winds_up() ? wind_up() : drive(message);
}

Answer Drive::ready(const ordered_json& message) {
  const auto first = reins_.ready(message);
  if (!first)
    return refuse(first.error());
  if (!*first)
    return print({{"wish", reins_.wish()}});
  auto& robot = reins_.robot();
  Request request(request_, said_);
  auto run = Run::start(request, {.report = true}, &robot, **first);
  if (!run)
    return tl::unexpected(run.error());
  run_ = *std::move(run);
  run_->keep_waiting();
  driven_ = std::make_unique<run::Driven>(run_->live(), robot, run_->listener(), options_);
  return fmt::format(R"({{"robot":{},"report":{}}})",
                     print(ordered_json(spec::info(options_.robot).title)), run_->report_so_far());
}

Answer Drive::drive(const ordered_json& message) {
  bool ends = message.value("stop", false);
  // One pass for what arrived, and one for the program's reaction.
  for (int i = 0; i < 2 && !ends; ++i) {
    const auto course = driven_->step();
    if (!course)
      trouble_ = course.error().message;
    else
      has_ended_ = *course == run::Driven::Progress::Ends;
    ends = course != run::Driven::Progress::GoesOn;
  }
  if (ends) {
    driven_->end();
    reins_.wind_up();
    reins_.take({{"at", message.at("at")}}); // the robot may be reached again
    return wind_up();
  }
  auto text = print(reins_.give(milliseconds(driven_->nap())));
  if (message.value("frame", false)) // already JSON
    text.replace(text.size() - 1, 1, ",\"frame\":" + run_->frame() + "}");
  return text;
}

Answer Drive::wind_up() {
  if (reins_.is_wound_up(driven_->hear()))
    return over();
  constexpr double often_ms = 5;
  return print(reins_.give(often_ms));
}

Answer Drive::over() {
  const bool stopped = reins_.robot().acknowledged();
  if (!has_ended_)
    run_->stop();
  const auto answer = run_->answer();
  if (!answer)
    return answer;
  return fmt::format(R"({{"over":{},"write":{},"stopped":{},"trouble":{}}})", *answer,
                     print(reins_.give(0).at("write")), stopped, print(ordered_json(trouble_)));
}

} // namespace orb::playground
