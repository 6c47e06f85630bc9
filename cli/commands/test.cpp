#include "base/text/text.h"
#include "cli/commands/commands.h"
#include "cli/context/language.h"
#include "cli/input/inputs.h"
#include "cli/input/links.h"
#include "cli/input/programs.h"
#include "cli/model/checks.h"
#include "cli/robot/ball_profile.h"
#include "cli/run/robot_stage.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress_bar.h"
#include "disk/disk.h"
#include "testing/run_suite.h"
#include "testing/verdicts/merge.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/report.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <thread>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr unsigned most_jobs = 1000;
// Each run takes some 350 bytes of memory until the end.
constexpr std::uint64_t most_runs = 2'000'000;
/// Where to look for tests by default.
const std::vector<std::string> test_paths{"."};

struct TestOptions {
  std::vector<std::string> paths;
  std::vector<std::string> programs;
  std::string class_folder; ///< empty: no class
  unsigned jobs = 0;
  std::string seeds;
  std::string only;
  std::string shard;
  std::string format = "text";
  std::string output;
  std::string report;
  std::string ball; ///< a profile; empty for none
  PortOptions port; ///< of a robot; empty for the virtual ball
  std::string robot;
  bool yes = false;
  bool merge = false;
};

/// The test files below a folder, sorted by name.
tl::expected<std::vector<std::string>, Failure> find_tests(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(disk::as_path(folder),
                                      fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error))
    if (std::error_code unreadable;
        testing::is_test(at->path().string()) && at->is_regular_file(unreadable))
      found.push_back(
          (folder == "." ? at->path().lexically_relative(".") : at->path()).generic_string());
  if (error)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("cannot read {}: {}", folder, error.message())});
  std::sort(found.begin(), found.end());
  return found;
}

/// Returns the tests in a file that holds a link to the playground.
tl::expected<std::vector<testing::GivenFile>, Failure> tests_in_link(const std::string& path) {
  const auto folders = read_link_file(path);
  if (!folders)
    return tl::unexpected(folders.error());
  std::vector<testing::GivenFile> tests;
  for (const auto& [folder, shared] : *folders) {
    if (!shared.trouble.empty())
      return tl::unexpected(Failure{ExitCode::BadInput, shared.trouble});
    for (const auto& [name, text] : shared.files)
      if (testing::is_test(name))
        tests.push_back({folder + "/" + name, text});
  }
  if (tests.empty())
    return tl::unexpected(Failure{ExitCode::Usage, fmt::format("there are no tests in {}", path)});
  return tests;
}

/// Reads the given files and those in the given folders.
tl::expected<std::vector<testing::GivenFile>, Failure>
read_tests(const std::vector<std::string>& paths) {
  std::vector<testing::GivenFile> files;
  const auto add = [&](const std::string& path) -> tl::expected<void, Failure> {
    auto text = read_text(path);
    if (!text)
      return tl::unexpected(text.error());
    const auto name = disk::display_name(path);
    const bool known = std::any_of(files.begin(), files.end(),
                                   [&](const auto& file) { return file.name == name; });
    if (!known)
      files.push_back({name, *std::move(text)});
    return {};
  };
  for (const auto& path : paths) {
    std::error_code absent;
    if (is_link_file(path) && !fs::is_directory(disk::as_path(path), absent)) {
      auto tests = tests_in_link(path);
      if (!tests)
        return tl::unexpected(tests.error());
      files.insert(files.end(), tests->begin(), tests->end());
      continue;
    }
    if (!fs::is_directory(disk::as_path(path), absent)) {
      if (auto added = add(path); !added)
        return tl::unexpected(added.error());
      continue;
    }
    const auto found = find_tests(path);
    if (!found)
      return tl::unexpected(found.error());
    if (found->empty())
      return tl::unexpected(Failure{ExitCode::Usage, fmt::format("there are no {} files below {}",
                                                                 testing::file_ending, path)});
    for (const auto& one : *found)
      if (auto added = add(one); !added)
        return tl::unexpected(added.error());
  }
  return files;
}

tl::expected<testing::Shard, Failure> read_shard(const std::string& text) {
  testing::Shard shard;
  if (text.empty())
    return shard;
  const auto slash = text.find('/');
  const auto number = [](std::string_view digits) {
    return parse_number<std::uint64_t>(digits).value_or(0);
  };
  const auto index = number(std::string_view(text).substr(0, slash));
  const auto count =
      slash == std::string::npos ? 0 : number(std::string_view(text).substr(slash + 1));
  if (index < 1 || index > count)
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`--shard {}` is not a shard; write it like 3/16, the third of sixteen",
                            text)});
  return testing::Shard{index, count};
}

/// The tests from the command line; for a class without any, those that came with its programs.
tl::expected<std::vector<testing::GivenFile>, Failure> given_tests(const TestOptions& options) {
  const bool none_named = options.paths == test_paths;
  return none_named && !options.class_folder.empty() ? read_class_tests(options.class_folder)
                                                     : read_tests(options.paths);
}

/// Shows the number of finished runs.
class Bar final : public testing::Progress {
public:
  explicit Bar(const Context& context) : bar_(context, "runs") {}
  void on_cases(std::uint64_t done, std::uint64_t all) override { bar_.show(done, all); }

private:
  CountBar bar_;
};

/// Shows nothing: on a robot each case is announced before it begins.
class NoBar final : public testing::Progress {
public:
  void on_cases(std::uint64_t, std::uint64_t) override {}
};

/// Writes a report into its folder. Removes an old index first and writes the new one last, so a
/// folder with an index has a complete report.
class ReportFolder final : public testing::Pages {
public:
  explicit ReportFolder(std::string folder) : folder_(std::move(folder)) {}

  tl::expected<void, Failure> begin() {
    const auto index = folder_ + "/index.html";
    std::error_code error;
    if (fs::exists(disk::as_path(index), error)) {
      const auto old = disk::read(index);
      if (!old || !old->starts_with(testing::report_mark))
        return refuse(
            fmt::format("{} is not a report from `orb test`; choose another folder", index));
      fs::remove(disk::as_path(index), error);
      fs::remove(disk::as_path(folder_ + "/certificates.html"), error);
      for (const auto& part : parts)
        for (const auto& file : fs::directory_iterator(disk::as_path(folder_ + part), error))
          remove_old(file.path());
    }
    for (const auto& part : parts) {
      fs::create_directories(disk::as_path(folder_ + part), error);
      if (error)
        return refuse(fmt::format("cannot create {}{}: {}", folder_, part, error.message()));
    }
    return {};
  }

  bool write(const std::string& name, std::string_view text) override {
    auto written = disk::write(folder_ + "/" + name, as_bytes(text));
    if (!written)
      problem_ = written.error().message;
    return problem_.empty();
  }

  const std::string& problem() const { return problem_; }

private:
  static tl::unexpected<Failure> refuse(std::string message) {
    return tl::unexpected(Failure{ExitCode::File, std::move(message)});
  }

  /// Removes a file of an earlier report, recognised by its name.
  static void remove_old(const fs::path& path) {
    const auto stem = path.stem().string();
    const bool ours = (path.extension() == ".svg" || path.extension() == ".html") &&
                      !stem.empty() && std::all_of(stem.begin(), stem.end(), is_digit);
    std::error_code kept;
    if (ours)
      fs::remove(path, kept);
  }

  static constexpr std::array<const char*, 2> parts{"/runs", "/pupils"};

  std::string folder_;
  std::string problem_;
};

testing::Speech speech_of(const Context& context) {
  return {say_in(context.ui_language), spoken_language(context.ui_language)};
}

tl::expected<void, Failure> write_report(const Context& context, const std::string& folder,
                                         const testing::Suite& suite,
                                         const testing::Results& results,
                                         const std::map<std::string, std::string>& names) {
  ReportFolder pages(folder);
  if (auto ready = pages.begin(); !ready)
    return ready;
  if (!testing::write_report(suite, results, pages, names, speech_of(context)))
    return tl::unexpected(Failure{ExitCode::File, pages.problem()});
  return {};
}

tl::expected<testing::SuiteOptions, Failure> suite_options(const Context& context,
                                                           const TestOptions& options) {
  testing::SuiteOptions wanted;
  wanted.only = options.only;
  if (testing::is_for_people(testing::format_called(options.format)))
    wanted.say = say_in(context.ui_language);
  if (!options.ball.empty()) {
    auto profile = read_profile(options.ball, {});
    if (!profile)
      return tl::unexpected(profile.error());
    wanted.ball = testing::NamedProfile{options.ball, *profile};
  }
  if (options.seeds.empty())
    return wanted;
  wanted.seeds = testing::parse_seeds(options.seeds);
  if (wanted.seeds && wanted.seeds->count() > testing::most_seeds)
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`--seeds {}` asks for too many seeds; a test takes at most {}",
                            options.seeds, testing::most_seeds)});
  if (!wanted.seeds)
    return tl::unexpected(Failure{
        ExitCode::Usage,
        fmt::format("`--seeds {}` is not a range of seeds; write it like 1..20", options.seeds)});
  return wanted;
}

/// Prints the findings of the test files; returns true if nothing may run because of them.
bool are_wrong(Context& context, const testing::Suite& suite) {
  bool wrong = false;
  for (const auto& file : suite.files)
    wrong = print_findings(context, *file.source, file.file.diagnostics) || wrong;
  if (wrong)
    context.exit = ExitCode::Usage;
  return wrong;
}

tl::expected<void, Failure> write_results(const Context& context, const TestOptions& options,
                                          const testing::Results& results) {
  const auto listing = context.quiet ? testing::Listing::Failures : testing::Listing::All;
  const bool to_file = !options.output.empty();
  const auto text = testing::render(results, testing::format_called(options.format), listing,
                                    to_file ? Style{} : context.out_style(), speech_of(context));
  if (!to_file) {
    print_out(text);
    return {};
  }
  if (const auto written = disk::write(options.output, as_bytes(text)); !written)
    return tl::unexpected(Failure{ExitCode::File, written.error().message});
  print_note(context, testing::render_summary(results, speech_of(context).say));
  return {};
}

/// Prints the results and sets the exit code.
tl::expected<void, Failure> tell_results(Context& context, const TestOptions& options,
                                         const testing::Results& results) {
  if (auto written = write_results(context, options, results); !written)
    return written;
  if (testing::totals_of(results).failed > 0)
    context.exit = ExitCode::BadInput;
  return {};
}

/// Merges the results of shards.
tl::expected<void, Failure> join(Context& context, const TestOptions& options) {
  if (!options.report.empty() || !options.programs.empty() || !options.class_folder.empty() ||
      !options.seeds.empty() || !options.shard.empty() || !options.only.empty() ||
      !options.ball.empty())
    return tl::unexpected(Failure{
        ExitCode::Usage, "`--merge` runs nothing: it takes only `--format` and `--output`"});
  if (options.paths == test_paths)
    return tl::unexpected(Failure{
        ExitCode::Usage, "`--merge` needs the files that shards wrote with `--format json`"});
  std::vector<testing::Part> parts;
  for (const auto& path : options.paths) {
    const auto text = read_text(path);
    if (!text)
      return tl::unexpected(text.error());
    auto part = testing::read_results(disk::display_name(path), *text);
    if (!part)
      return tl::unexpected(part.error());
    parts.push_back(*std::move(part));
  }
  const auto results = testing::merge(std::move(parts));
  if (!results)
    return tl::unexpected(results.error());
  return tell_results(context, options, *results);
}

/// Reports a test file among the programs: `--program` takes all words after it.
tl::expected<void, Failure> check_programs(const TestOptions& options) {
  if (!options.class_folder.empty() && !options.programs.empty())
    return tl::unexpected(
        Failure{ExitCode::Usage, "`--class` names the programs; omit `--program`"});
  std::error_code absent;
  if (!options.class_folder.empty() &&
      !fs::is_directory(disk::as_path(options.class_folder), absent))
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("`--class {}` is not a folder", options.class_folder)});
  for (const auto& path : options.programs)
    if (testing::is_test(path))
      return tl::unexpected(Failure{
          ExitCode::Usage,
          fmt::format("`--program` takes programs, but {} is a test; put it before `--program`",
                      path)});
  return {};
}

/// Reads what `--program` names, as far as possible.
tl::expected<void, Failure> add_programs(const TestOptions& options,
                                         const std::vector<testing::GivenFile>& tests,
                                         testing::SuiteOptions& wanted,
                                         std::map<std::string, std::string>& names) {
  std::set<std::string> stems;
  for (const auto& file : tests)
    stems.insert(std::string(stem(file.name)));
  auto found = read_programs(options.class_folder.empty() ? options.programs
                                                          : std::vector{options.class_folder},
                             stems, wanted.say);
  if (!found)
    return tl::unexpected(found.error());
  wanted.programs = std::move(found->programs);
  wanted.troubles = std::move(found->troubles);
  wanted.missing = std::move(found->missing);
  names = std::move(found->pupils);
  return {};
}

tl::expected<void, Failure> report_and_tell(Context& context, const TestOptions& options,
                                            const testing::Suite& suite,
                                            const testing::Results& results,
                                            const std::map<std::string, std::string>& names) {
  if (!options.report.empty())
    if (auto written = write_report(context, options.report, suite, results, names); !written)
      return written;
  return tell_results(context, options, results);
}

/// Runs the tests on a robot, one after the other. Prints the results known so far even if the link
/// is lost.
tl::expected<void, Failure> test_robot(Context& context, const TestOptions& options,
                                       const testing::Suite& suite, testing::RunOptions run,
                                       const std::map<std::string, std::string>& names) {
  const InterruptGuard guard;
  auto robot = connect_robot(context, options.port, options.robot);
  if (!robot)
    return tl::unexpected(robot.error());
  RobotStage stage(**robot, options.yes ? Attended::No : Attended::Yes, suite.cases);
  run.judge = [&](const auto&... one) {
    return testing::play_case(one..., [&](auto&... all) { return stage.play(all...); });
  };
  NoBar none;
  const auto results = testing::run_suite(suite, run, none);
  if (auto told = report_and_tell(context, options, suite, results, names); !told)
    return told;
  if (stage.broken())
    return tl::unexpected(*stage.broken());
  return {};
}

/// Checks options that need a robot, or exclude one.
tl::expected<void, Failure> check_port(const TestOptions& options) {
  const auto refuse = [](std::string message) {
    return tl::unexpected(Failure{ExitCode::Usage, std::move(message)});
  };
  if (options.port.port.empty()) {
    if (options.yes)
      return refuse("`--yes` is for tests on a robot; add `--port URL`");
    if (!options.robot.empty())
      return refuse("`--robot` says which robot answers; add `--port URL`");
  } else if (!options.ball.empty()) {
    return refuse("`--ball` says how a virtual ball drives; omit it, or omit `--port`");
  } else if (options.jobs > 1) {
    return refuse("a robot runs one test at a time; omit `--jobs`");
  }
  return {};
}

tl::expected<void, Failure> run_tests(Context& context, const TestOptions& options) {
  if (options.merge)
    return join(context, options);
  if (auto fits = check_port(options); !fits)
    return fits;
  if (auto programs = check_programs(options); !programs)
    return programs;
  auto wanted = suite_options(context, options);
  if (!wanted)
    return tl::unexpected(wanted.error());
  const auto shard = read_shard(options.shard);
  if (!shard)
    return tl::unexpected(shard.error());
  auto files = given_tests(options);
  if (!files)
    return tl::unexpected(files.error());
  std::map<std::string, std::string> names;
  if (auto programs = add_programs(options, *files, *wanted, names); !programs)
    return programs;
  DiskFiles disk;
  const auto suite = testing::make_suite(*std::move(files), *wanted, disk);
  if (!suite)
    return tl::unexpected(suite.error());
  if (are_wrong(context, *suite))
    return {};
  if (const auto runs = suite->cases / shard->count; runs > most_runs)
    return tl::unexpected(Failure{
        ExitCode::Usage,
        fmt::format("these are {} runs, but one command does at most {}; `--shard` divides them",
                    runs, most_runs)});
  testing::RunOptions run;
  run.jobs = options.jobs != 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  run.shard = *shard;
  if (!options.port.port.empty())
    return test_robot(context, options, *suite, std::move(run), names);
  const auto results = [&] {
    Bar bar(context);
    return testing::run_suite(*suite, run, bar);
  }();
  return report_and_tell(context, options, *suite, results, names);
}

} // namespace

void add_test(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("test", "test programs and judge the results",
                      "orb test\norb test corner.test\norb test task.test --program *.bas\n"
                      "orb test maze.test --seeds 1..200 --format junit --output tests.xml\n"
                      "orb test --class results --report results/page\n"
                      "orb test corner.test --port ble://SB-1A2B\n"
                      "orb test --shard 1/2 --format json > a.json\n"
                      "orb test --merge a.json b.json --format markdown");
  auto options = std::make_shared<TestOptions>();
  options->paths = test_paths;
  command
      .add_option("FILE", options->paths,
                  "test files, and folders to search for them; with --merge, results")
      .show_default();
  command.add_option(
      "--program", options->programs,
      "programs to test, each with every test, instead of those the tests name; for a "
      "folder, those in it and one from each folder in it");
  command
      .add_option("--class", options->class_folder,
                  "a folder of pupils' work: files with playground addresses, programs, or a "
                  "folder for each pupil; without FILE, the tests come from the addresses")
      .type_name("FOLDER");
  command.add_option("--jobs", options->jobs, "how many runs at once; 0: one for each processor")
      .check(whole_number(0, most_jobs))
      .show_default();
  command.add_option("--seeds", options->seeds, "the seeds for every test, such as 1..200");
  command.add_option("--only", options->only, "run only the test with this name");
  command.add_option("--shard", options->shard,
                     "a share of the runs: 3/16 is the third of sixteen");
  std::vector<std::string> formats(testing::format_names().begin(), testing::format_names().end());
  command.add_option("--format", options->format, "how results are printed")
      .check(one_of(std::move(formats)))
      .show_default();
  command.add_option("--output", options->output, "the file for the results; by default stdout");
  command
      .add_option("--report", options->report,
                  "a folder for a page with a picture of each run and a replay of each failure")
      .type_name("FOLDER");
  add_ball_option(command, options->ball,
                  "virtual balls drive like the robot that `orb calibrate` measured");
  add_robot_port_options(command, options->port, options->robot);
  command.add_flag("--yes", options->yes, "the robot is on its mark: do not ask before each test");
  command.add_flag("--merge", options->merge,
                   "merge the result files that shards wrote with --format json");
  command.callback([&context, options] {
    if (const auto done = run_tests(context, *options); !done)
      fail(context, done.error());
  });
}

} // namespace orb::cli
