#include "playground/engine/runs.h"

#include "base/duration.h"
#include "base/text/utf8.h"
#include "playground/engine/sources.h"
#include "run/want.h"
#include "structured/text/structured_words.h"
#include "vm/stimulus.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {
namespace {

/// How long to watch a ball that keeps driving after its program has ended.
constexpr Duration watched = 5s;

int rgb(vm::Color color) {
  return color.red << 16 | color.green << 8 | color.blue;
}

tl::expected<std::unique_ptr<debug::Launched>, Problem> launch(Request& request) {
  debug::Launch launch;
  launch.files = request.names;
  launch.stimuli = request.texts("stimuli");
  launch.course = request.text("course");
  launch.seed = request.value<std::uint64_t>("seed");
  launch.numbers =
      request.value<std::vector<std::int32_t>>("input").value_or(std::vector<std::int32_t>{});
  launch.client = request.flag("connected", true) ? run::Client::Connected : run::Client::Absent;
  launch.shape = structured::Shape::Shortest; // compiled to the lines that the robot would run
  auto launched = debug::read(launch, request.files);
  if (!launched)
    return tl::unexpected(
        Problem{launched.error().code, launched.error().message, check(request).value_or("")});
  return *std::move(launched);
}

ordered_json fault_json(const run::ProgramError& fault, const Say& say) {
  return {{"file", fault.file},
          {"line", fault.place.line},
          {"column", fault.place.column},
          {"robot_line", fault.robot_line},
          {"code", spec::code(fault.code)},
          {"message", spec::info(fault.code).text},
          {"seen", fault.cause.seen},
          {"variables", fault.cause.variables},
          {"finding", say(fault.finding)},
          {"help", say(run::help_of(fault))},
          {"text", run::render(fault, Style{})}};
}

ordered_json ending_json(const run::Ending& ending, const Say& say) {
  auto faults = ordered_json::array();
  for (const auto& fault : ending.faults)
    faults.push_back(fault_json(fault, say));
  return {{"reason", run::to_string(ending.reason)},
          {"ms", milliseconds(ending.lasted)},
          {"lines", ending.lines},
          {"words", run::to_string(ending)},
          {"story", run::story(ending)},
          {"waits_for", ending.waits_for},
          {"aborted", ending.aborted},
          {"faults", std::move(faults)}};
}

ordered_json pose_json(const vm::Pose& pose) {
  return {{"x", pose.x_cm},
          {"y", pose.y_cm},
          {"heading", pose.heading_deg},
          {"speed", pose.speed_cm_s}};
}

} // namespace

tl::expected<std::unique_ptr<Run>, Problem>
Run::start(Request& request, const Wanted& wanted, vm::RemoteBody* robot, const vm::Sample& first) {
  auto launched = launch(request);
  if (!launched)
    return tl::unexpected(launched.error());
  std::unique_ptr<Run> made(new Run);
  made->title_ = request.names.front();
  made->say_ = request.said.say();
  made->wanted_ = wanted;
  made->launched_ = *std::move(launched);
  auto& options = made->launched_->options;
  const auto bound = parse_duration(request.text("for", "60s"), 1s);
  if (!bound)
    return refuse(ExitCode::Usage, fmt::format("`{}` is not a time", request.text("for")));
  options.bound = *bound;
  options.robot = robot;
  options.robot_sample = first;
  options.line = request.value<std::uint16_t>("line");
  options.trace_lines = request.flag("trace_lines");
  options.until = request.text("until", wanted.report ? "rest" : "quiet") == "rest"
                      ? run::Until::Rest
                      : run::Until::Quiet;
  if (const auto right = run::check_start_line(made->launched_->inputs, options.line); !right)
    return refuse(right.error());
  if (wanted.report)
    made->journey_.emplace();
  if (wanted.trace)
    made->trace_.emplace(*wanted.trace,
                         options.trace_lines ? report::TraceLines::Keep : report::TraceLines::Leave,
                         made->launched_->inputs,
                         [text = &made->trace_text_](std::string_view line) { *text += line; });
  auto live = run::Live::start(made->launched_->inputs, options, *made,
                               made->journey_ ? &*made->journey_ : nullptr);
  if (!live)
    return refuse(live.error());
  made->live_ = *std::move(live);
  return made;
}

void Run::finish() {
  while (live_->advance(live_->time() + launched_->options.slice)) {
  }
}

bool Run::advance(Duration t) {
  while (!over_ && live_->time() < t)
    if (!live_->advance(t)) {
      over_ = !live_->waits_for_number();
      if (!over_)
        live_->wait(t);
    }
  if (!over_ && live_->rolls_out()) {
    rolls_since_ = rolls_since_.value_or(live_->time());
    over_ = live_->time() - *rolls_since_ > watched;
  } else {
    rolls_since_.reset();
  }
  return !over_;
}

void Run::stop() {
  if (!over_ && !live_->rolls_out())
    live_->stop();
}

tl::expected<void, Problem> Run::apply(const std::string& line) {
  const bool is_wall = line.starts_with("wall ");
  const Source source("stimulus", is_wall ? line : "at 0s " + line);
  const auto script = vm::parse_stimulus(source);
  if (!script.diagnostics.empty())
    return refuse(ExitCode::BadInput, say_(script.diagnostics.front().message));
  for (const auto& event : script.events) {
    live_->apply(event.stimulus);
    // The user's action becomes a stimulus of the run, so no hint says later that it is missing.
    launched_->options.stimuli.push_back({live_->time(), event.stimulus});
  }
  return {};
}

std::string Run::hint() const {
  const auto want = run::want(launched_->inputs, launched_->options);
  return want ? want->advice : "";
}

std::string Run::frame() {
  const auto& ball = live_->ball();
  const auto prints = std::string_view(prints_).substr(told_prints_);
  auto faults = ordered_json::array();
  for (const auto& fault : std::exchange(faults_, {}))
    faults.push_back(fault_json(fault, say_));
  const ordered_json frame{{"ms", milliseconds(live_->time())},
                           {"pose", pose_json(ball.body().pose())},
                           {"led", rgb(ball.led())},
                           {"prints", from_latin1(prints)},
                           {"waits_for", live_->waits_for_number() ? "a number" : ""},
                           {"faults", std::move(faults)},
                           {"ended", rolls_since_ ? run::to_string(live_->so_far()) : ""}};
  told_prints_ = prints_.size();
  auto text = print(frame);
  if (journey_) // already JSON
    text.replace(text.size() - 1, 1, ",\"more\":" + report::growth_json(*journey_, shown_) + "}");
  return text;
}

std::string Run::report_so_far() const {
  auto until_now = *journey_;
  until_now.finish(live_->time(), "running", "still running");
  return report_of(until_now);
}

Answer Run::answer() {
  const auto ending = live_->finish();
  if (!ending)
    return refuse(ending.error());
  if (trace_)
    trace_->finish(*ending);
  ordered_json answer{
      {"ending", ending_json(*ending, say_)}, {"hint", hint()}, {"prints", from_latin1(prints_)}};
  if (trace_)
    answer["trace"] = trace_text_;
  auto text = print(answer);
  if (wanted_.report) // already JSON
    text.replace(text.size() - 1, 1, ",\"report\":" + report_of(*journey_) + "}");
  return text;
}

void Run::on_event(Duration t, const vm::Event& event) {
  if (const auto* printed = std::get_if<vm::event::Print>(&event))
    prints_ += printed->text;
  if (trace_)
    trace_->add(t, event);
}

void Run::on_fault(Duration t, const run::ProgramError& fault) {
  if (trace_)
    trace_->add(t, fault);
  faults_.push_back(fault);
}

std::string Run::report_of(const report::Journey& journey) const {
  return report::run_json(journey, title_, structured::keyword_words);
}

} // namespace orb::playground
