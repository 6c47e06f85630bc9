#include "playground/engine/engine.h"
#include "playground/engine/sources.h"
#include "playground/engine/tests.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {

const Engine::Row Engine::rows[] = {
    {"said", &Engine::said},
    {"version", &Engine::version},
    {"check", &Engine::plain<playground::check>},
    {"format", &Engine::plain<playground::format>},
    {"build", &Engine::plain<playground::build>},
    {"assemble", &Engine::plain<playground::assemble>},
    {"tree", &Engine::plain<playground::tree>},
    {"words", &Engine::plain<playground::words>},
    {"lift", &Engine::plain<playground::lift>},
    {"test", &Engine::plain<playground::test>},
    {"replay", &Engine::plain<playground::replay>},
    {"links", &Engine::plain<playground::links>},
    {"tell_robot", &Engine::plain<playground::tell_robot>},
    {"hear_robot", &Engine::hear_robot},
    {"run", &Engine::run},
    {"files", &Engine::files},
    {"lsp", &Engine::lsp},
    {"live_start", &Engine::live_start},
    {"live_advance", &Engine::live_advance},
    {"live_end", &Engine::live_end},
    {"stimulus", &Engine::stimulus},
    {"input", &Engine::input},
    {"report", &Engine::report},
    {"deliver_start", &Engine::deliver_start},
    {"deliver_step", &Engine::deliver_step},
    {"drive_start", &Engine::drive_start},
    {"drive_step", &Engine::drive_step},
    {"world", &Engine::of_floor<&Floor::add_world>},
    {"robot", &Engine::of_floor<&Floor::add_robot>},
    {"robot_fork", &Engine::of_floor<&Floor::fork>},
    {"robot_link", &Engine::of_robot<link_robot>},
    {"robot_step", &Engine::of_robot<step_robot>},
    {"robot_state", &Engine::of_robot<state_of_robot>},
    {"robot_stimulus", &Engine::of_robot<stimulate_robot>},
    {"robot_reset", &Engine::of_robot<reset_robot>},
    {"robot_journey", &Engine::of_robot<journey_of_robot>},
    {"robot_end", &Engine::end_robot},
    {"edu_start", &Engine::start_edu},
    {"edu_step", &Engine::of_edu<&EduRuns::step>},
    {"edu_end", &Engine::end_edu},
    {"missing_files", &Engine::plain<missing_files>},
    {"trials_start", &Engine::of_trials<&Trials::start>},
    {"trial_robot", &Engine::add_robot_of_trial},
    {"trial_print", &Engine::of_trial<&Trials::print>},
    {"trial_judge", &Engine::of_trial<&Trials::judge>},
    {"trial_fail", &Engine::of_trials<&Trials::fail>},
    {"trials_end", &Engine::of_trials<&Trials::end>},
};

namespace {

const std::string nothing = "{}";

tl::unexpected<Problem> no_run() {
  return refuse(ExitCode::Usage, "nothing runs");
}

} // namespace

Answer Engine::call(const std::string& method, const ordered_json& params) {
  for (const auto& row : rows)
    if (row.name == method) {
      Request request(params, said_);
      return (this->*row.method)(request);
    }
  return refuse(ExitCode::Usage, fmt::format("there is no method `{}`", method));
}

Answer Engine::files(Request& request) {
  folder_ = request.files;
  return nothing;
}

Answer Engine::lsp(Request& request) {
  const auto& message = request.params.at("message");
  std::string messages;
  for (const auto& one :
       server_.receive(message.is_string() ? message.get<std::string>() : print(message)))
    messages += (messages.empty() ? "" : ",") + one;
  return fmt::format(R"({{"messages":[{}]}})", messages);
}

Answer Engine::run(Request& request) {
  Wanted wanted;
  const auto trace = request.text("trace");
  if (!trace.empty())
    wanted.trace = trace == "csv" ? report::TraceFormat::Csv : report::TraceFormat::Json;
  wanted.report = request.flag("report");
  const auto run = Run::start(request, wanted);
  if (!run)
    return tl::unexpected(run.error());
  (*run)->finish();
  return (*run)->answer();
}

Answer Engine::live_start(Request& request) {
  live_.reset();
  auto run = Run::start(request, {.report = true});
  if (!run)
    return tl::unexpected(run.error());
  live_ = *std::move(run);
  live_->keep_waiting();
  const auto hint = print(live_->hint());
  return fmt::format(R"({{"hint":{},"report":{}}})", hint, live_->report_so_far());
}

Answer Engine::live_advance(Request& request) {
  if (!live_)
    return no_run();
  const bool goes_on = live_->advance(duration_of(request.value<double>("ms").value_or(0)));
  return fmt::format(R"({{"over":{},"frame":{}}})", !goes_on, live_->frame());
}

Answer Engine::live_end(Request&) {
  if (!live_)
    return no_run();
  live_->stop();
  const auto run = std::move(live_);
  return run->answer();
}

Answer Engine::stimulus(Request& request) {
  if (!live_)
    return no_run();
  if (const auto done = live_->apply(request.text("line")); !done)
    return tl::unexpected(done.error());
  return nothing;
}

Answer Engine::input(Request& request) {
  auto* const run = drive_ ? drive_->run() : live_.get();
  if (run == nullptr)
    return no_run();
  run->give(request.value<std::int32_t>("value").value_or(0));
  return nothing;
}

Answer Engine::report(Request&) {
  return live_ ? Answer(live_->report_so_far()) : no_run();
}

Answer Engine::deliver_start(Request& request) {
  auto upload = Upload::start(request);
  if (!upload)
    return tl::unexpected(upload.error());
  upload_ = *std::move(upload);
  return upload_->step(ordered_json::object());
}

Answer Engine::deliver_step(Request& request) {
  if (!upload_)
    return refuse(ExitCode::Usage, "nothing is being uploaded");
  return upload_->step(request.params);
}

Answer Engine::drive_start(Request& request) {
  drive_.reset();
  auto drive = Drive::start(request);
  if (!drive)
    return tl::unexpected(drive.error());
  drive_ = *std::move(drive);
  return drive_->step(ordered_json::object());
}

Answer Engine::drive_step(Request& request) {
  if (!drive_)
    return refuse(ExitCode::Usage, "no robot is driven");
  auto answer = drive_->step(request.params);
  if (!answer || answer->starts_with(R"({"over")"))
    drive_.reset();
  return answer;
}

std::string Engine::answer(const char* request) {
  const auto message = ordered_json::parse(request);
  const auto answer = call(message.at("method").get<std::string>(),
                           message.value("params", ordered_json::object()));
  return answer ? fmt::format(R"({{"result":{}}})", *answer) : refusal(answer.error());
}

std::string refusal(const Problem& problem) {
  const ordered_json error = {{"code", static_cast<int>(problem.code)},
                              {"message", problem.message}};
  if (problem.findings.empty())
    return print({{"error", error}});
  const auto plain = print(error);
  return fmt::format(R"({{"error":{},"findings":{}}}}})", plain.substr(0, plain.size() - 1),
                     problem.findings);
}

} // namespace orb::playground
