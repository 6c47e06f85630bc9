#include "run/room.h"
#include "spec/firmware.h"
#include "testing/replay.h"
#include "testing/run_suite.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>

namespace orb::testing {
namespace {

// bytes; longer printed lines are cut. The robot's own are a few dozen characters long.
constexpr std::size_t longest_line = 4096;

/// Listens to a run and informs its judges. Large because every kind of event updates one sighting,
/// which all judges share.
class Court final : public run::Listener {
public:
  /// How long a run goes on.
  enum class Goes : std::uint8_t { UntilKnown, ToTheEnd };

  /// All balls of a room, in order.
  using Balls = std::vector<const vm::Ball*>;

  /// In a room: judges its ball `own`, which also sees the others.
  Court(const Test& test, const Group& group, Goes goes, std::optional<std::size_t> own = {},
        Balls* all = nullptr)
      : keeps_on_(goes == Goes::ToTheEnd), own_(own), all_(all) {
    judges_.reserve(test.expectations.size());
    for (std::size_t i = 0; i < test.expectations.size(); ++i) {
      const auto& one = test.expectations[i];
      if (one.ball != own_ && one.line != 0)
        continue;
      places_.push_back(i);
      judges_.push_back(make_judge(one, group.meanings[i]));
      if (one.line == 0)
        silent_ = judges_.back().get();
    }
  }

  /// The indices of the missed expectations, each with its judge.
  std::vector<std::pair<std::size_t, const Judge*>> missed() const {
    std::vector<std::pair<std::size_t, const Judge*>> found;
    for (std::size_t i = 0; i < judges_.size(); ++i)
      if (judges_[i]->decision() == Judge::Decision::Missed)
        found.emplace_back(places_[i], judges_[i].get());
    return found;
  }

  void on_start(const vm::Ball& ball) override {
    ball_ = &ball;
    if (all_ != nullptr)
      (*all_)[*own_] = &ball;
    sighting_.color = ball.led();
    look(ball.body());
  }

  void on_event(Duration t, const vm::Event& event) override {
    move_on(t);
    std::visit([&](const auto& seen) { take(t, seen); }, event);
    settle();
  }

  void on_fault(Duration t, const run::ProgramError& fault) override {
    move_on(t);
    const auto at = moment(t, static_cast<int>(fault.robot_line));
    for (const auto& judge : judges_)
      judge->on_error(at, fault);
    settle();
  }

  void on_step(Duration t, const vm::Body& body) override {
    move_on(t);
    look(body);
  }

  void on_time(Duration t) override {
    move_on(t);
    for (const auto& judge : judges_)
      judge->on_time(t);
    settle();
  }

  void on_end(const run::Ending& ending) override {
    if (!line_.empty())
      print_line(ending.lasted);
    move_on(std::max(ending.seen_to, since_));
    sighting_.over = ending.reason != run::Reason::TimeLimit && ending.reason != run::Reason::Input;
    const auto at = moment(since_, 0);
    for (const auto& judge : judges_)
      judge->see(at, Duration::max(), sighting_);
    const Outcome outcome{&ending, ball_, ending.lasted, ball_->body().way_cm(), ending.lines};
    for (const auto& judge : judges_)
      judge->on_end(at, outcome);
  }

  /// True if nothing that may still happen can change a verdict. `never error` is final only at the
  /// end, but a run that has already failed does not go on for it.
  bool enough() const override { return enough_ && !keeps_on_; }

private:
  template <class Other>
  void take(Duration, const Other&) {}

  void take(Duration t, const vm::event::Print& print) {
    std::string_view text = print.text;
    for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos;
         text.remove_prefix(end + 1)) {
      line_ += text.substr(0, std::min(end, longest_line - line_.size()));
      print_line(t);
    }
    line_ += text.substr(0, longest_line - line_.size());
  }
  void take(Duration, const vm::event::Led& led) { sighting_.color = led.color; }
  void take(Duration, const vm::event::BackLed& back) { sighting_.back = back.value; }
  void take(Duration, const vm::event::Position&) { look(ball_->body()); }
  void take(Duration t, const vm::event::Marker& marker) {
    const auto at = moment(t);
    for (const auto& judge : judges_)
      judge->on_marker(at, marker);
  }
  void take(Duration t, const vm::event::Bump& bump) {
    const auto at = moment(t);
    for (const auto& judge : judges_)
      judge->on_bump(at, bump);
  }
  void take(Duration, const vm::event::Macro& macro) { macro_ = macro; }
  void take(Duration t, const vm::event::Sleep&) {
    sighting_.asleep = true;
    slept_at_ = t;
  }

  void print_line(Duration t) {
    if (line_.ends_with('\r'))
      line_.pop_back();
    const auto at = moment(t, ball_->basic_running() ? ball_->machine().asking_line() : 0);
    for (const auto& judge : judges_)
      judge->on_print(at, {line_});
    line_.clear();
  }

  void look(const vm::Body& body) {
    const auto pose = body.world_pose();
    sighting_.x = pose.x_cm;
    sighting_.y = pose.y_cm;
    sighting_.heading = pose.heading_deg;
    sighting_.speed = pose.speed_cm_s;
    sighting_.moving = !body.stopped();
    sighting_.has_moved = sighting_.has_moved || sighting_.moving;
    if (all_ != nullptr)
      look_around();
  }

  /// Updates the positions of all balls. A ball that has not begun yet is put where nobody looks.
  void look_around() {
    sighting_.balls.resize(all_->size());
    for (std::size_t i = 0; i < all_->size(); ++i)
      if ((*all_)[i] != nullptr)
        sighting_.balls[i] = (*all_)[i]->body().mover().place;
  }

  /// Passes on what was seen until `t`.
  void move_on(Duration t) {
    if (!uncertain_states_)
      return;
    // A ball is asleep from this event on; a later sighting shows when it wakes.
    const Moment from{since_, running_};
    bool open = false;
    for (const auto& judge : judges_) {
      if (judge->certain())
        continue;
      judge->see(from, t, sighting_);
      open = true;
    }
    uncertain_states_ = open;
    since_ = t;
    running_ = running();
    const bool runs = ball_->basic_running() || ball_->macros().running();
    started_ = started_ || runs;
    sighting_.over = started_ && !runs;
    if (sighting_.asleep && t > slept_at_)
      sighting_.asleep = ball_->asleep();
  }

  /// What runs now; unchanged while a line waits, as in `delay`.
  Running running() {
    if (!ball_->basic_running())
      return macro_ && ball_->macros().running() ? Running{0, macro_->id, macro_->command}
                                                 : Running{};
    if (const auto lines = ball_->machine().lines(); lines != looked_at_) {
      looked_at_ = lines;
      line_running_ = ball_->machine().line();
    }
    return {line_running_, 0, 0};
  }

  Moment moment(Duration t) { return {t, running()}; }
  Moment moment(Duration t, int line) {
    auto at = moment(t);
    if (line != 0)
      at.running = {line, 0, 0};
    return at;
  }

  void settle() {
    bool missed = false;
    bool open = false;
    for (const auto& judge : judges_) {
      missed = missed || judge->decision() == Judge::Decision::Missed;
      open = open || (!judge->certain() && judge.get() != silent_);
    }
    enough_ = !open && (missed || silent_ == nullptr || silent_->certain());
  }

  std::vector<std::unique_ptr<Judge>> judges_;
  const Judge* silent_ = nullptr;
  const vm::Ball* ball_ = nullptr;
  bool keeps_on_;
  std::optional<std::size_t> own_; ///< index of the ball in the room
  Balls* all_;
  std::vector<std::size_t> places_; ///< indices of the judges' expectations
  bool enough_ = false;
  bool uncertain_states_ = true;
  bool started_ = false; ///< true once something has run
  Sighting sighting_;
  Duration since_{};
  Running running_;
  std::uint64_t looked_at_ = UINT64_MAX;
  int line_running_ = 0;
  std::optional<vm::event::Macro> macro_;
  Duration slept_at_{};
  std::string line_;
};

/// The text of an expectation as written.
std::string expected(const SuiteFile& file, const Expectation& one) {
  return one.line == 0 ? "never error" : std::string(file.source->text(one.span));
}

Miss miss_of(const Suite& suite, const Group& group, const Expectation& one, const Judge& judge,
             std::size_t program) {
  const auto& file = suite.files[group.file];
  Miss miss{
      one.line == 0 ? suite.test_of(group).line : one.line, expected(file, one), judge.seen(), {}};
  if (judge.moment())
    miss.where = place_of(suite.programs[program], judge.moment()->running);
  return miss;
}

} // namespace

run::Options options_of(const Suite& suite, const Group& group, std::uint64_t seed) {
  const auto& file = suite.files[group.file];
  const auto& test = suite.test_of(group);
  run::Options options;
  options.bound = test.bound;
  options.seed = seed;
  options.target = target_of(file.file);
  options.firmware = file.file.firmware;
  options.stimuli = test.stimuli;
  options.course = file.course.get();
  options.until = run::Until::Rest;
  if (std::any_of(test.expectations.begin(), test.expectations.end(), watches_steps))
    options.steps = run::Steps::Heard;
  if (suite.ball)
    options.drive_like(suite.ball->profile);
  return options;
}

namespace {

using Run = std::function<tl::expected<run::Ending, Failure>(const run::Options& options,
                                                             run::Listener& listener)>;

/// The result of a case whose judges have heard the end.
CaseResult result_of(const Suite& suite, const Group& group, const Court& court,
                     const run::Options& options, const run::Ending& ending) {
  CaseResult result;
  result.seed = options.seed;
  result.lasted = ending.lasted;
  result.lines = ending.lines;
  for (const auto& [place, judge] : court.missed())
    result.misses.push_back(
        miss_of(suite, group, suite.test_of(group).expectations[place], *judge, group.program));
  if (!result.misses.empty()) {
    result.verdict = Verdict::Failed;
    constexpr Duration little = 250ms; // rolling on for less than this is not visible
    result.again =
        replay_command(suite, group, options.seed, ending.seen_to - ending.lasted > little);
  }
  return result;
}

/// Judges the run that `run` starts.
CaseResult judge_case(const Suite& suite, const Group& group, const run::Options& options,
                      Court::Goes goes, const Run& run) {
  const auto fail = [&](std::string problem) {
    CaseResult result;
    result.seed = options.seed;
    result.verdict = Verdict::Error;
    result.problem = std::move(problem);
    return result;
  };
  if (const auto& obstacle = suite.programs[group.program].obstacle(); !obstacle.empty())
    return fail(obstacle);
  Court court(suite.test_of(group), group, goes);
  const auto ending = run(options, court);
  return ending ? result_of(suite, group, court, options, *ending)
                : fail(ending.error().message + "\n");
}

/// The balls of a room with their programs.
std::vector<run::RoomBall> room_of(const Suite& suite, const Group& group,
                                   const run::Options& options) {
  std::vector<run::RoomBall> balls;
  const auto& placed = suite.files[group.file].file.balls;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    auto& ball = balls.emplace_back();
    ball.name = placed[i].name.text;
    ball.inputs = suite.programs[group.room[i]].inputs;
    ball.options = options;
    ball.options.start = placed[i].start;
    ball.options.seed = run::seed_of(options.seed, ball.name);
  }
  return balls;
}

/// Runs a room and adds its duration, or why it cannot be run.
void run_and_add(std::span<const run::RoomBall> balls, CaseResult& result) {
  const auto endings = run::run_room(balls);
  if (!endings) {
    result.problem = endings.error().message + "\n";
    return;
  }
  for (const auto& ending : *endings) {
    result.lasted = std::max(result.lasted, ending.lasted);
    result.lines += ending.lines;
  }
}

/// Collects the journeys of the balls, ordered by name as pictures show them.
void film(std::vector<run::RoomBall>& balls, Footage& footage) {
  std::vector<run::RoomBall*> by_name;
  for (auto& ball : balls)
    by_name.push_back(&ball);
  std::sort(by_name.begin(), by_name.end(),
            [](const auto* a, const auto* b) { return a->name < b->name; });
  for (auto* ball : by_name)
    ball->journey = &footage.emplace_back(SeenBall{ball->name, {}}).journey;
}

/// Runs the balls of a room together and judges each by the expectations about it.
CaseResult judge_room(const Suite& suite, const Group& group, const run::Options& options,
                      Court::Goes goes, Footage* footage) {
  const auto& test = suite.test_of(group);
  CaseResult result;
  result.seed = options.seed;
  for (const auto program : group.room)
    result.problem += suite.programs[program].obstacle();
  auto balls = room_of(suite, group, options);
  Court::Balls all(balls.size());
  std::deque<Court> courts;
  for (std::size_t i = 0; i < balls.size(); ++i)
    balls[i].listener = &courts.emplace_back(test, group, goes, i, &all);
  if (footage != nullptr)
    film(balls, *footage);
  if (result.problem.empty())
    run_and_add(balls, result);
  if (!result.problem.empty()) {
    result.verdict = Verdict::Error;
    return result;
  }
  for (std::size_t i = 0; i < courts.size(); ++i)
    for (const auto& [place, judge] : courts[i].missed()) {
      auto& miss = result.misses.emplace_back(
          miss_of(suite, group, test.expectations[place], *judge, group.room[i]));
      if (test.expectations[place].line == 0)
        miss.expected = fmt::format("never {} error", balls[i].name);
    }
  std::stable_sort(result.misses.begin(), result.misses.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
  if (!result.misses.empty()) {
    result.verdict = Verdict::Failed;
    result.again = replay_command(suite, group, options.seed);
  }
  return result;
}

} // namespace

CaseResult run_case(const Suite& suite, const Group& group, std::uint64_t seed,
                    vm::NativePrograms* native, Footage* footage) {
  auto options = options_of(suite, group, seed);
  options.native_programs = native;
  const auto goes = footage == nullptr ? Court::Goes::UntilKnown : Court::Goes::ToTheEnd;
  if (!group.room.empty())
    return judge_room(suite, group, options, goes, footage);
  auto* journey = footage == nullptr ? nullptr : &footage->emplace_back().journey;
  return judge_case(
      suite, group, options, goes, [&](const run::Options& given, run::Listener& listener) {
        return run::run(suite.programs[group.program].inputs, given, listener, journey);
      });
}

CaseResult play_case(const Suite& suite, const Group& group, std::uint64_t seed, const Play& play) {
  const auto options = options_of(suite, group, seed);
  auto footage = std::make_shared<Footage>(1);
  auto result = judge_case(suite, group, options, Court::Goes::UntilKnown,
                           [&](const run::Options& given, run::Listener& listener) {
                             return play(suite, group, given, listener, footage->front().journey);
                           });
  result.again.clear(); // the virtual ball would behave differently
  result.footage = std::move(footage);
  return result;
}

struct Trial::State {
  const Suite& suite;
  const Group& group;
  run::Options options;
  Court court;
};

Trial::Trial(const Suite& suite, const Group& group, std::uint64_t seed)
    : state_(new State{suite, group, options_of(suite, group, seed),
                       Court(suite.test_of(group), group, Court::Goes::ToTheEnd)}) {}

Trial::~Trial() = default;

const run::Options& Trial::options() const {
  return state_->options;
}

run::Listener& Trial::listener() {
  return state_->court;
}

CaseResult Trial::judge(const run::Ending& ending) const {
  return result_of(state_->suite, state_->group, state_->court, state_->options, ending);
}

} // namespace orb::testing
