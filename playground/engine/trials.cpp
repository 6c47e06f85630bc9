#include "playground/engine/trials.h"

#include "playground/engine/tests.h"
#include "robot/words.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string>

namespace orb::playground {
namespace {

/// More would take hours, each with a sandbox of its own.
constexpr std::size_t most_cases = 10'000;

class NoProgress final : public testing::Progress {
public:
  void on_cases(std::uint64_t, std::uint64_t) override {}
};

/// Notes which files are asked for in vain.
class NotingFiles final : public structured::Files {
public:
  explicit NotingFiles(structured::Files& files) : files_(files) {}

  std::optional<std::string> read(const std::string& path) override {
    auto text = files_.read(path);
    if (!text)
      missing_.insert(path);
    return text;
  }
  const std::set<std::string>& missing() const { return missing_; }

private:
  structured::Files& files_;
  std::set<std::string> missing_;
};

tl::unexpected<Problem> no_such_case() {
  return refuse(ExitCode::Usage, "there is no such case");
}

} // namespace

/// What is heard of a robot while the program of a case drives it.
class Trials::Run final : public vm::Observer, public vm::StepObserver {
public:
  Run(robot::Robot& robot, const testing::Suite& suite, const Case& one)
      : one_(one), robot_(robot), trial_(suite, *one.group, one.seed) {}
  ~Run() override { robot_.watch(nullptr, nullptr); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const Case& which() const { return one_; }

  void begin() {
    begin_ = robot_.now();
    robot_.schedule(trial_.options().stimuli);
    trial_.listener().on_start(robot_.ball());
    robot_.watch(this, this);
  }

  void over() { is_over_ = true; }

  void print(std::string text) {
    on_event(Instant{robot_.now()}, vm::event::Print{std::move(text)});
  }

  testing::CaseResult judge(run::Ending ending) {
    const auto& bound = trial_.options().bound;
    if (ending.reason != run::Reason::TimeLimit)
      await_rest(begin_ + bound);
    robot_.watch(nullptr, nullptr);
    ending.lasted = std::min(ending.lasted, bound);
    ending.seen_to = std::clamp(robot_.now() - begin_, ending.lasted, bound);
    trial_.listener().on_end(ending);
    auto result = trial_.judge(ending);
    constexpr auto usual = spec::Robot::Bolt;
    if (!result.again.empty() && robot_.kind().robot != usual)
      result.again += fmt::format(" --robot {}", robot_.kind().name);
    return result;
  }

private:
  /// As long as the run goes on: the robot is stopped a little later.
  bool is_heard(Instant at) const {
    return at.time_since_epoch() <= begin_ + trial_.options().bound;
  }
  Duration time_of(Instant at) const { return at.time_since_epoch() - begin_; }

  /// After the program only the effects of the robot's motion count: its lamps are put out.
  void on_event(Instant at, const vm::Event& event) override {
    const bool moves = std::holds_alternative<vm::event::Bump>(event) ||
                       std::holds_alternative<vm::event::Position>(event);
    if (is_heard(at) && (moves || !is_over_))
      trial_.listener().on_event(time_of(at), event);
  }
  void on_step(Instant at, const vm::Body& body) override {
    if (is_heard(at))
      trial_.listener().on_step(time_of(at), body);
  }

  void await_rest(Duration until) {
    constexpr Duration glance = 100ms;
    while (robot_.ball().body().moving() && robot_.now() < until)
      robot_.advance(std::min(glance, until - robot_.now()));
  }

  Case one_;
  robot::Robot& robot_;
  testing::Trial trial_;
  Duration begin_{};
  bool is_over_ = false;
};

Trials::Trials() = default;
Trials::~Trials() = default;

Answer Trials::start(Request& request) {
  forget(nullptr);
  results_.clear();
  cases_.clear();
  suite_.reset();
  auto suite = read_suite(request, request.files);
  if (!suite)
    return tl::unexpected(suite.error());
  suite_ = *std::move(suite);
  auto cases = ordered_json::array();
  auto sources = ordered_json::object();
  for (const auto& group : suite_->groups) {
    const auto& program = suite_->programs[group.program];
    if (!program.is_javascript() || !program.problem.empty() || !group.room.empty())
      continue;
    if (cases_.size() + group.seeds.count() > most_cases)
      return refuse(ExitCode::Usage,
                    fmt::format("at most {} runs of JavaScript are tested at once", most_cases));
    sources[program.name] = request.files.read(program.name).value_or("");
    const auto& test = suite_->test_of(group);
    for (auto seed = group.seeds.first; seed <= group.seeds.last; ++seed) {
      cases.push_back({{"number", cases_.size()},
                       {"file", suite_->files[group.file].source->name()},
                       {"test", test.name.text},
                       {"program", program.name},
                       {"seed", seed},
                       {"seconds", robot::in_seconds(test.bound)}});
      cases_.push_back({&group, seed});
    }
  }
  return playground::print({{"cases", cases}, {"sources", sources}});
}

tl::expected<Trials::Case, Problem> Trials::find(const Request& request) const {
  const auto number = request.value<std::size_t>("number").value_or(cases_.size());
  if (number >= cases_.size())
    return no_such_case();
  return cases_[number];
}

void Trials::take(const Case& one, testing::CaseResult result) {
  result.seed = one.seed;
  results_.insert_or_assign({one.group, one.seed}, std::move(result));
}

Answer Trials::add_robot(Request& request, Floor& floor) {
  const auto one = find(request);
  if (!one)
    return tl::unexpected(one.error());
  const auto kind = robot::read_kind(request.text("kind", "bolt"));
  if (!kind)
    return refuse(ExitCode::Usage, kind.error());
  const auto& course = suite_->files[one->group->file].course;
  robot::Options options;
  options.seed = one->seed;
  auto robot = std::make_unique<robot::Robot>(*kind, options, course ? *course : report::Course{});
  runs_[robot.get()] = std::make_unique<Run>(*robot, *suite_, *one);
  return floor.keep(std::move(robot));
}

void Trials::begin(const robot::Robot& robot) {
  if (const auto run = runs_.find(&robot); run != runs_.end())
    run->second->begin();
}

void Trials::over(const robot::Robot& robot) {
  if (const auto run = runs_.find(&robot); run != runs_.end())
    run->second->over();
}

Answer Trials::print(robot::Robot& robot, Request& request) {
  const auto run = runs_.find(&robot);
  if (run == runs_.end())
    return no_such_case();
  run->second->print(request.text("text"));
  return std::string("{}");
}

Answer Trials::judge(robot::Robot& robot, Request& request) {
  const auto run = runs_.find(&robot);
  if (run == runs_.end())
    return no_such_case();
  const auto lasted = robot::read_seconds(request.value<double>("seconds").value_or(0));
  if (!lasted)
    return refuse(ExitCode::Usage, lasted.error());
  const auto how = request.text("how");
  run::Ending ending;
  ending.reason = how == "done"    ? run::Reason::End
                  : how == "limit" ? run::Reason::TimeLimit
                                   : run::Reason::Abort;
  ending.lasted = *lasted;
  ending.aborted = request.text("error");
  auto result = run->second->judge(std::move(ending));
  const auto verdict = testing::to_string(result.verdict);
  take(run->second->which(), std::move(result));
  runs_.erase(run);
  return playground::print({{"verdict", verdict}});
}

Answer Trials::fail(Request& request) {
  const auto one = find(request);
  if (!one)
    return tl::unexpected(one.error());
  testing::CaseResult result;
  result.verdict = testing::Verdict::Error;
  result.problem = request.text("problem");
  take(*one, std::move(result));
  return std::string("{}");
}

Answer Trials::end(Request& request) {
  if (!suite_)
    return no_such_case();
  testing::RunOptions options;
  options.judge = [&](const testing::Suite& suite, const testing::Group& group,
                      std::uint64_t seed) {
    const auto known = results_.find({&group, seed});
    return known == results_.end() ? testing::run_case(suite, group, seed, nullptr, nullptr)
                                   : known->second;
  };
  NoProgress progress;
  return results_of(testing::run_suite(*suite_, options, progress), request);
}

void Trials::forget(const robot::Robot* robot) {
  if (robot != nullptr)
    runs_.erase(robot);
  else
    runs_.clear();
}

Answer missing_files(Request& request) {
  NotingFiles files(request.files);
  // Its mistakes are found when it is tested.
  const auto suite = read_suite(request, files);
  return print({{"missing", files.missing()}});
}

} // namespace orb::playground
