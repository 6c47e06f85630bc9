#include "cli/many/many.h"

#include "base/text/text.h"
#include "base/text/utf8.h"
#include "cli/context/json.h"
#include "cli/terminal/interrupt.h"
#include "disk/disk.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <thread>

namespace orb::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view error_mark = "orb: error: ";
constexpr auto pause_before_try = std::chrono::seconds{1};
/// longest delay until an interruption is noticed
constexpr auto notice = std::chrono::milliseconds{20};

/// The result for one robot.
struct Outcome {
  ExitCode exit = ExitCode::Interrupted;
  std::string verdict = "not started";
  std::string out; ///< captured output, if it was not shown
  std::string signal;
  bool is_shown = true; ///< the verdict is among the printed lines
  int tries = 0;
  double seconds = 0;
};

/// Splits a thread's output into lines.
class Lines {
public:
  explicit Lines(std::function<void(std::string_view)> take) : take_(std::move(take)) {}
  void add(std::string_view text) {
    text_ += text;
    std::size_t begin = 0;
    for (auto end = text_.find('\n'); end != text_.npos; end = text_.find('\n', begin)) {
      take_(std::string_view(text_).substr(begin, end - begin));
      begin = end + 1;
    }
    text_.erase(0, begin);
  }
  void end() {
    if (!text_.empty())
      take_(std::exchange(text_, {}));
  }

private:
  std::function<void(std::string_view)> take_;
  std::string text_;
};

bool is_worth_a_try(ExitCode exit, TryAgain again) {
  return exit == ExitCode::NoBall ||
         (again == TryAgain::Lost && (exit == ExitCode::LinkLost || exit == ExitCode::Unknown));
}

/// Marks the robots that share the Bluetooth adapter.
std::vector<bool> over_ble(const Roster& roster) {
  std::vector<bool> over;
  for (const auto& member : roster.members) {
    const auto endpoint = find_endpoint(roster.config, member.port);
    over.push_back(endpoint && endpoint->scheme == uploader::Scheme::Ble);
  }
  return over;
}

/// Waits, unless the user interrupts.
void wait_before_try() {
  for (const auto until = Clock::now() + pause_before_try;
       Clock::now() < until && InterruptGuard::asked() == 0;)
    std::this_thread::sleep_for(notice);
}

/// Works with all robots, a few at a time.
class Crew {
public:
  Crew(const Context& context, const Roster& roster, int tries, const ManyOptions& options,
       const Work& work)
      : roster_(roster), tries_(tries), options_(options), work_(work),
        board_(context, roster.members), outcomes_(roster.members.size()),
        over_ble_(over_ble(roster)), begun_(roster.members.size()) {
    context_ = context;
    context_.config = roster.config;
    context_.color = "never"; // captured output is shown elsewhere
    context_.quiet = false;   // hidden output may contain the verdict
  }

  std::vector<Outcome> run(std::size_t jobs) {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < std::min(jobs, outcomes_.size()); ++i)
      threads.emplace_back([this] { take_turns(); });
    for (auto& thread : threads)
      thread.join();
    if (broken_)
      std::rethrow_exception(broken_);
    return std::move(outcomes_);
  }

private:
  void take_turns() {
    while (const auto turn = next()) {
      const auto i = *turn;
      try {
        handle(i);
      } catch (...) { // output lost, or a bug: the other robots go on
        const std::lock_guard lock(mutex_);
        broken_ = std::current_exception();
        outcomes_[i].verdict = "given up";
        board_.show(i, "");
      }
      if (over_ble_[i]) {
        const std::lock_guard lock(mutex_);
        --ble_links_;
        freed_.notify_all();
      }
    }
  }

  /// Returns the next robot, once the adapter has a free link for it; nothing if all have begun or
  /// the user interrupts.
  std::optional<std::size_t> next() {
    std::unique_lock lock(mutex_);
    while (InterruptGuard::asked() == 0) {
      bool all_begun = true;
      for (std::size_t i = 0; i < begun_.size(); ++i) {
        if (begun_[i])
          continue;
        all_begun = false;
        if (over_ble_[i] && ble_links_ == spec::ble_links_most)
          continue;
        begun_[i] = true;
        ble_links_ += over_ble_[i] ? 1 : 0;
        return i;
      }
      if (all_begun)
        break;
      freed_.wait_for(lock, notice);
    }
    return std::nullopt;
  }

  void handle(std::size_t i) {
    auto& outcome = outcomes_[i];
    const auto start = Clock::now();
    while (true) {
      board_.show(i, "connecting");
      Row row(board_, i);
      outcome.out.clear();
      ++outcome.tries;
      attempt(i, row);
      if (!row.signal().empty())
        outcome.signal = row.signal();
      if (outcome.tries >= tries_ || !is_worth_a_try(outcome.exit, options_.again) ||
          InterruptGuard::asked() > 0)
        break;
      board_.note(i, fmt::format("{}; trying again ({} of {})", outcome.verdict, outcome.tries + 1,
                                 tries_));
      wait_before_try();
    }
    board_.show(i, "");
    outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!outcome.is_shown)
      board_.note(i, outcome.verdict);
  }

  /// Does the work once. Output goes to the board, errors to the verdict.
  void attempt(std::size_t i, Row& row) {
    auto& outcome = outcomes_[i];
    std::string error;
    std::string last;  // the last line shown, without its indent
    std::string fault; // of the program
    Lines out([&](std::string_view line) {
      if (options_.json || options_.prints == Prints::Answer)
        outcome.out += fmt::format("{}\n", line);
      else
        board_.print(i, line);
    });
    Lines err([&](std::string_view line) {
      if (line.starts_with(error_mark)) {
        error += error.empty() ? "" : "; ";
        error += line.substr(error_mark.size());
      } else {
        board_.note(i, line);
        last = line.substr(std::min(line.find_first_not_of(' '), line.size()));
      }
      if (fault.empty() && line.find(": error: ") != line.npos && line.front() != ' ')
        fault = line;
    });
    Context context = context_;
    {
      const OutputTap tap([&](OutputTap::Stream stream, std::string_view text) {
        (stream == OutputTap::Stream::Out ? out : err).add(text);
      });
      work_(context, roster_.members[i], &row);
    }
    out.end();
    err.end();
    outcome.exit = context.exit;
    outcome.is_shown = error.empty() && row.verdict().empty();
    if (!error.empty() && !last.empty())
      error += "; " + last; // such as the result of stopping the robot
    outcome.verdict = !error.empty()           ? error
                      : !fault.empty()         ? fault
                      : !row.verdict().empty() ? row.verdict()
                      : !last.empty()          ? last
                      : outcome.exit == ExitCode::Done
                          ? "done"
                          : fmt::format("ended with exit code {}", static_cast<int>(outcome.exit));
    if (error.empty() && !outcome.out.empty() && !options_.json)
      take_answer(i);
  }

  /// Puts a one-line answer into the table, a longer one before it.
  void take_answer(std::size_t i) {
    auto& outcome = outcomes_[i];
    if (outcome.out.find('\n') == outcome.out.size() - 1)
      outcome.verdict = outcome.out.substr(0, outcome.out.size() - 1);
    else
      Lines([&](std::string_view line) { board_.print(i, line); }).add(outcome.out);
  }

  Context context_;
  const Roster& roster_;
  int tries_;
  const ManyOptions& options_;
  const Work& work_;
  Board board_;
  std::vector<Outcome> outcomes_;
  std::vector<bool> over_ble_;
  std::mutex mutex_; ///< guards the members below
  std::vector<bool> begun_;
  int ble_links_ = 0;
  std::condition_variable freed_; ///< signals a free link
  std::exception_ptr broken_;
};

std::string_view word(const Outcome& outcome) {
  return outcome.exit == ExitCode::Done          ? "ok"
         : outcome.exit == ExitCode::Interrupted ? "interrupted"
                                                 : "failed";
}

std::string summary(const std::vector<Outcome>& outcomes) {
  std::size_t done = 0;
  std::size_t interrupted = 0;
  for (const auto& outcome : outcomes) {
    done += outcome.exit == ExitCode::Done ? 1U : 0U;
    interrupted += outcome.exit == ExitCode::Interrupted ? 1U : 0U;
  }
  auto text = fmt::format("{} of {} robots done", done, outcomes.size());
  if (const auto failed = outcomes.size() - done - interrupted; failed > 0)
    text += fmt::format(", {} failed", failed);
  if (interrupted > 0)
    text += fmt::format(", {} interrupted", interrupted);
  return text;
}

void print_table(const Roster& roster, const std::vector<Outcome>& outcomes, const Style& style) {
  std::size_t names = 0;
  std::size_t signals = 0;
  std::size_t words = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    names = std::max(names, code_points(roster.members[i].name));
    signals = std::max(signals, outcomes[i].signal.size());
    words = std::max(words, word(outcomes[i]).size());
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto& name = roster.members[i].name;
    const auto role = outcomes[i].exit == ExitCode::Done ? Role::Good : Role::Error;
    print_out(fmt::format("{}{}  {}{}{}  {}\n", name, std::string(names - code_points(name), ' '),
                          style.paint(role, word(outcomes[i])),
                          std::string(words - word(outcomes[i]).size(), ' '),
                          signals == 0 ? "" : fmt::format("  {:>{}}", outcomes[i].signal, signals),
                          outcomes[i].verdict));
  }
  print_out(summary(outcomes) + "\n");
}

void print_document(const Roster& roster, const std::vector<Outcome>& outcomes,
                    std::string_view command) {
  Json robots = Json::array();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto& member = roster.members[i];
    const auto& outcome = outcomes[i];
    Json robot{{"name", member.name},        {"port", member.port},
               {"result", word(outcome)},    {"exit", static_cast<int>(outcome.exit)},
               {"verdict", outcome.verdict}, {"tries", outcome.tries},
               {"seconds", outcome.seconds}};
    if (!outcome.signal.empty())
      robot["signal"] = outcome.signal;
    if (auto answer = Json::parse(outcome.out, nullptr, false); answer.is_object())
      robot["answer"] = std::move(answer);
    robots.push_back(std::move(robot));
  }
  print_json({{"schema", "orb.robots/1"}, {"command", command}, {"robots", std::move(robots)}});
}

ExitCode exit_of(const std::vector<Outcome>& outcomes) {
  const auto any = [&](auto is) { return std::any_of(outcomes.begin(), outcomes.end(), is); };
  if (any([](const Outcome& one) { return one.exit == ExitCode::Interrupted; }))
    return ExitCode::Interrupted;
  return any([](const Outcome& one) { return one.exit != ExitCode::Done; }) ? ExitCode::Refused
                                                                            : ExitCode::Done;
}

/// Notes that the adapter cannot connect to all robots at once.
void say_who_waits(const Context& context, const Roster& roster, std::size_t jobs) {
  const auto over = over_ble(roster);
  const auto robots = static_cast<std::size_t>(std::count(over.begin(), over.end(), true));
  constexpr std::size_t most = spec::ble_links_most;
  if (std::min(robots, jobs) > most)
    print_note(context,
               fmt::format("over Bluetooth LE at most {} robots at a time: the other {} wait for "
                           "their turn",
                           most, robots - most));
}

} // namespace

std::string links_at_once() {
  return fmt::format("{}, which every Bluetooth adapter can handle", spec::ble_links_every);
}

void with_robots(Context& context, const RosterOptions& given, const ManyOptions& options,
                 const Work& work) {
  const auto roster = find_roster(context, given);
  if (!roster)
    return fail(context, roster.error());
  if (roster->is_one && !(options.one_too && options.json))
    return work(context, roster->members.front(), nullptr);
  if (options.check)
    if (const auto good = options.check(); !good)
      return fail(context, good.error());
  if (options.misfit)
    for (const auto& member : roster->members)
      if (const auto why = options.misfit(member))
        return fail(context,
                    {ExitCode::Usage, fmt::format("{}`{}` {}", member.place, member.name, *why)});
  const InterruptGuard guard;
  const auto wanted = given.jobs > 0 ? given.jobs : options.jobs;
  const auto jobs =
      wanted == all_at_once ? roster->members.size() : static_cast<std::size_t>(wanted);
  say_who_waits(context, *roster, jobs);
  const auto outcomes = Crew(context, *roster, given.tries, options, work).run(jobs);
  if (options.json)
    print_document(*roster, outcomes, options.command);
  else
    print_table(*roster, outcomes, context.out_style());
  context.exit = exit_of(outcomes);
}

Failure listens_to_one() {
  return {ExitCode::Usage, "`--monitor` listens to one robot; omit it, and use `orb monitor` "
                           "for one of them"};
}

PortOptions port_of(PortOptions options, const RosterMember& robot, const Row* row) {
  options.port = robot.port;
  if (row != nullptr)
    options.record = file_of(options.record, robot);
  return options;
}

std::string file_of(const std::string& file, const RosterMember& robot) {
  if (file.empty())
    return file;
  auto name = robot.name;
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return !is_letter(c) && !is_digit(c) && c != '-' && c != '_'; }, '_');
  const auto path = disk::as_path(file);
  auto own = path.parent_path() / path.stem();
  own += "-" + name;
  own += path.extension();
  return own.string();
}

} // namespace orb::cli
