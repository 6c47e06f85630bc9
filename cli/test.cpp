#include "base/text.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "disk/disk.h"
#include "testing/render.h"
#include "testing/run_suite.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <thread>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

struct TestOptions {
  std::vector<std::string> paths;
  std::vector<std::string> programs;
  unsigned jobs = 0;
  std::string seeds;
  std::string only;
  std::string shard;
  std::string format = "text";
  std::string output;
};

constexpr std::string_view ending = ".test";

/// The test files below a folder, in the order of their names.
tl::expected<std::vector<std::string>, Failure> find_tests(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error))
    if (std::error_code unreadable;
        at->path().extension() == ending && at->is_regular_file(unreadable))
      found.push_back((folder == "." ? at->path().lexically_relative(".") : at->path()).string());
  if (error)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("cannot read {}: {}", folder, error.message())});
  std::sort(found.begin(), found.end());
  return found;
}

/// Reads the files that were given, and those of the folders.
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
    if (!fs::is_directory(path, absent)) {
      if (auto added = add(path); !added)
        return tl::unexpected(added.error());
      continue;
    }
    const auto found = find_tests(path);
    if (!found)
      return tl::unexpected(found.error());
    if (found->empty())
      return tl::unexpected(
          Failure{ExitCode::Usage, fmt::format("there is no {} file below {}", ending, path)});
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
  const auto index = parse_number<std::uint64_t>(std::string_view(text).substr(0, slash));
  const auto count = slash == std::string::npos
                         ? std::nullopt
                         : parse_number<std::uint64_t>(std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count)
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`--shard {}` is not a share; write it like 3/16, the third of sixteen",
                            text)});
  return testing::Shard{*index, *count};
}

class NoProgress final : public testing::Progress {
public:
  void on_cases(std::uint64_t, std::uint64_t) override {}
};

tl::expected<testing::SuiteOptions, Failure> suite_options(const TestOptions& options) {
  testing::SuiteOptions wanted{options.programs, {}, options.only};
  if (options.seeds.empty())
    return wanted;
  wanted.seeds = testing::parse_seeds(options.seeds);
  if (!wanted.seeds)
    return tl::unexpected(
        Failure{ExitCode::Usage,
                fmt::format("`--seeds {}` are no seeds; write them like 1..20", options.seeds)});
  return wanted;
}

/// Tells what is wrong with the test files; whether nothing is run for it.
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
                                    to_file ? Style{} : context.out_style());
  if (!to_file) {
    print_out(text);
    return {};
  }
  if (const auto written = disk::write(options.output, as_bytes(text)); !written)
    return tl::unexpected(Failure{ExitCode::File, written.error().message});
  print_note(context, testing::render_summary(results));
  return {};
}

tl::expected<void, Failure> test(Context& context, const TestOptions& options) {
  const auto wanted = suite_options(options);
  if (!wanted)
    return tl::unexpected(wanted.error());
  const auto shard = read_shard(options.shard);
  if (!shard)
    return tl::unexpected(shard.error());
  auto files = read_tests(options.paths);
  if (!files)
    return tl::unexpected(files.error());
  DiskFiles disk;
  const auto suite = testing::make_suite(*std::move(files), *wanted, disk);
  if (!suite)
    return tl::unexpected(suite.error());
  if (are_wrong(context, *suite))
    return {};
  testing::RunOptions run;
  run.jobs = options.jobs != 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  run.shard = *shard;
  NoProgress progress;
  const auto results = testing::run_suite(*suite, run, progress);
  if (auto written = write_results(context, options, results); !written)
    return written;
  if (testing::totals_of(results).failed > 0)
    context.exit = ExitCode::BadInput;
  return {};
}

} // namespace

void add_test(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "test", "run the tests of programs and judge them",
                  "orb test\norb test corner.test\norb test task.test --program *.bas\n"
                  "orb test maze.test --seeds 1..200 --format junit --output tests.xml");
  auto options = std::make_shared<TestOptions>();
  options->paths = {"."};
  command->add_option("FILE", options->paths, "test files, and folders to search for them")
      ->capture_default_str();
  command->add_option("--program", options->programs,
                      "programs to test, each with every test, in place of those the tests name");
  command->add_option("--jobs", options->jobs, "how many runs at once; 0: one for each processor")
      ->capture_default_str();
  command->add_option("--seeds", options->seeds, "the seeds of every test, such as 1..200");
  command->add_option("--only", options->only, "runs the one test of this name");
  command->add_option("--shard", options->shard,
                      "a share of the runs: 3/16 is the third of sixteen");
  std::vector<std::string> formats(testing::format_names().begin(), testing::format_names().end());
  command->add_option("--format", options->format, "how results are printed")
      ->check(one_of(std::move(formats)))
      ->capture_default_str();
  command->add_option("--output", options->output, "the file for the results; else stdout");
  command->callback([&context, options] {
    if (const auto done = test(context, *options); !done)
      fail(context, done.error());
  });
}

} // namespace orb::cli
