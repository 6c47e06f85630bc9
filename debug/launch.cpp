#include "debug/launch.h"

#include "base/render.h"
#include "testing/run_suite.h"
#include "vm/stimulus.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::debug {
namespace {

tl::unexpected<Failure> failed(ExitCode code, std::string message) {
  return tl::unexpected(Failure{code, std::move(message)});
}

/// The errors among findings, with places, one per line.
std::string errors_of(const Source& source, const std::vector<Diagnostic>& found) {
  std::string all;
  for (const auto& one : found)
    if (is_error(one)) {
      const auto place = source.position(one.span.begin);
      all += fmt::format("{}{}:{}:{}: {}", all.empty() ? "" : "\n", source.name(), place.line,
                         place.column, in_one_line(one));
    }
  return all;
}

std::string errors_of(const run::Input& input) {
  std::string all;
  for (const auto& file : input.errors)
    if (const auto more = errors_of(*file.source, file.diagnostics); !more.empty())
      all += (all.empty() ? "" : "\n") + more;
  return all;
}

tl::expected<std::string, Failure> text_of(const std::string& path, structured::Files& files) {
  auto text = files.read(path);
  if (!text)
    return failed(ExitCode::File, fmt::format("cannot read {}", path));
  return *std::move(text);
}

tl::expected<void, Failure> read_files(const Launch& launch, structured::Files& files,
                                       Launched& made) {
  for (const auto& path : launch.files) {
    auto text = text_of(path, files);
    if (!text)
      return tl::unexpected(text.error());
    auto input = run::read_input(path, *std::move(text), launch.language, made.options.target,
                                 files, {}, launch.shape.value_or(structured::Shape::Steppable));
    if (!input)
      return tl::unexpected(input.error());
    if (auto wrong = errors_of(*input); !wrong.empty())
      return failed(ExitCode::BadInput, std::move(wrong));
    run::add_input(made.own, *std::move(input));
  }
  made.inputs = made.own;
  return {};
}

tl::expected<void, Failure> read_stimuli(const Launch& launch, structured::Files& files,
                                         Launched& made) {
  auto& events = made.options.stimuli;
  for (const auto& one : launch.stimuli) {
    const bool is_line = vm::is_stimulus_line(one);
    auto text = is_line ? tl::expected<std::string, Failure>(one) : text_of(one, files);
    if (!text)
      return tl::unexpected(text.error());
    const Source source(is_line ? "stimulus" : one, *std::move(text));
    const auto script = vm::parse_stimulus(source);
    if (auto wrong = errors_of(source, script.diagnostics); !wrong.empty())
      return failed(ExitCode::BadInput, std::move(wrong));
    events.insert(events.end(), script.events.begin(), script.events.end());
  }
  vm::sort_by_time(events);
  return {};
}

tl::expected<void, Failure> read_course(const Launch& launch, structured::Files& files,
                                        Launched& made) {
  if (launch.course.empty())
    return {};
  auto text = text_of(launch.course, files);
  if (!text)
    return tl::unexpected(text.error());
  const Source drawing(launch.course, *std::move(text));
  auto reading = report::read_course(drawing);
  if (auto wrong = errors_of(drawing, reading.findings); !wrong.empty())
    return failed(ExitCode::BadInput, std::move(wrong));
  made.course = std::make_unique<report::Course>(std::move(reading.course));
  made.options.course = made.course.get();
  return {};
}

tl::expected<void, Failure> read_test(const Launch& launch, structured::Files& files,
                                      Launched& made) {
  auto text = text_of(launch.test, files);
  if (!text)
    return tl::unexpected(text.error());
  testing::SuiteOptions options;
  options.only = launch.test_name;
  options.shape = launch.shape.value_or(structured::Shape::Shortest);
  if (!launch.files.empty())
    options.programs = {launch.files.front()};
  auto suite = testing::make_suite({{launch.test, *std::move(text)}}, options, files);
  if (!suite)
    return tl::unexpected(suite.error());
  made.suite = std::make_unique<testing::Suite>(*std::move(suite));
  for (const auto& file : made.suite->files)
    if (auto wrong = errors_of(*file.source, file.file.diagnostics); !wrong.empty())
      return failed(ExitCode::BadInput, std::move(wrong));
  if (made.suite->groups.empty())
    return failed(ExitCode::BadInput, fmt::format("{} contains no tests", launch.test));
  const auto& group = made.suite->groups.front();
  const auto& program = made.suite->programs[group.program];
  if (const auto& obstacle = program.obstacle(); !obstacle.empty())
    return failed(ExitCode::BadInput, obstacle.substr(0, obstacle.find('\n')));
  made.inputs = program.inputs;
  made.options = testing::options_of(*made.suite, group, launch.seed.value_or(group.seeds.first));
  return {};
}

} // namespace

tl::expected<std::unique_ptr<Launched>, Failure> read(const Launch& launch,
                                                      structured::Files& files) {
  auto made = std::make_unique<Launched>();
  made->options.seed = launch.seed.value_or(made->options.seed);
  if (!launch.test.empty()) {
    if (auto done = read_test(launch, files, *made); !done)
      return tl::unexpected(done.error());
  } else {
    for (const auto step : {read_files, read_stimuli, read_course})
      if (auto done = step(launch, files, *made); !done)
        return tl::unexpected(done.error());
  }
  made->options.numbers = launch.numbers;
  made->options.client = launch.client;
  made->options.bound = Duration{};
  if (launch.profile)
    made->options.drive_like(*launch.profile);
  return made;
}

tl::expected<void, Failure> check_for_robot(const Launched& launched) {
  const auto& options = launched.options;
  if (options.course != nullptr && launched.suite == nullptr)
    return failed(ExitCode::Usage, "a course is for the virtual ball; omit it, or omit "
                                   "the port");
  if (options.client == run::Client::Absent)
    return failed(ExitCode::Usage, "a robot that is driven from here has a client: omit "
                                   "`disconnected`");
  for (const auto& event : options.stimuli)
    if (!std::holds_alternative<vm::stimulus::Number>(event.stimulus))
      return failed(ExitCode::Usage, "with a robot, a stimulus can only be an `input`: shake and "
                                     "push the robot by hand, or omit the port");
  return {};
}

} // namespace orb::debug
