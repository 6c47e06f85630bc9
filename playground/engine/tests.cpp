#include "playground/engine/tests.h"

#include "base/render.h"
#include "report/page.h"
#include "structured/text/structured_words.h"
#include "testing/run_suite.h"
#include "testing/verdicts/render.h"

#include <fmt/format.h>
#include <utility>

namespace orb::playground {
namespace {

class Unwatched final : public testing::Progress {
public:
  void on_cases(std::uint64_t, std::uint64_t) override {}
};

tl::expected<testing::Suite, Problem>
make_suite(Request& request, const testing::SuiteOptions& options, structured::Files& files) {
  std::vector<testing::GivenFile> given;
  for (const auto& name : request.names) {
    auto text = request.read(name);
    if (!text)
      return tl::unexpected(text.error());
    given.push_back({name, *std::move(text)});
  }
  auto suite = testing::make_suite(std::move(given), options, files);
  if (!suite)
    return refuse(suite.error());
  if (!suite->has_errors())
    return *std::move(suite);
  std::vector<FileFindings> findings;
  for (const auto& file : suite->files)
    findings.push_back({file.source.get(), file.file.diagnostics, {}});
  return tl::unexpected(Problem{ExitCode::Usage, "the tests have mistakes",
                                render_json(findings, request.said.say())});
}

testing::SuiteOptions suite_options(const Request& request) {
  testing::SuiteOptions options;
  options.say = request.said.say();
  options.programs = request.texts("programs");
  options.only = request.text("only");
  if (const auto seeds = request.text("seeds"); !seeds.empty())
    options.seeds = testing::parse_seeds(seeds);
  return options;
}

} // namespace

tl::expected<testing::Suite, Problem> read_suite(Request& request, structured::Files& files) {
  return make_suite(request, suite_options(request), files);
}

Answer results_of(const testing::Results& results, Request& request) {
  const auto json = testing::render_json(results, request.said.say());
  const auto format = request.text("format");
  if (format == "json")
    return fmt::format(R"({{"results":{}}})", json);
  const auto text = format == "junit"
                        ? testing::render_junit(results)
                        : testing::render_text(results, testing::Listing::All, Style{});
  return fmt::format(R"({{"text":{},"results":{}}})", print(text), json);
}

Answer test(Request& request) {
  const auto suite = read_suite(request, request.files);
  if (!suite)
    return tl::unexpected(suite.error());
  Unwatched progress;
  return results_of(testing::run_suite(*suite, {}, progress), request);
}

Answer replay(Request& request) {
  testing::SuiteOptions options;
  options.say = request.said.say();
  options.only = request.text("test");
  if (const auto program = request.text("program"); !program.empty())
    options.programs = {program};
  const auto suite = make_suite(request, options, request.files);
  if (!suite)
    return tl::unexpected(suite.error());
  if (suite->groups.empty())
    return refuse(ExitCode::Usage, fmt::format("there is no test `{}`", options.only));
  const auto& group = suite->groups.front();
  const auto& program = suite->programs[group.program];
  if (!program.obstacle().empty())
    return refuse(ExitCode::BadInput, program.obstacle());
  const auto seed = request.value<std::uint64_t>("seed").value_or(group.seeds.first);
  testing::Footage footage;
  testing::run_case(*suite, group, seed, nullptr, &footage);
  const auto title =
      fmt::format("{}: {}, seed {}", program.name, suite->test_of(group).name.text, seed);
  return fmt::format(R"({{"report":{}}})",
                     report::run_json(footage.front().journey, title, structured::keyword_words));
}

} // namespace orb::playground
