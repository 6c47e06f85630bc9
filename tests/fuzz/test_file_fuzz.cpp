// Reads any text as a test file, looks up what it names among a few files, runs what could be read
// for a moment and prints it in every format.

#include "testing/run_suite.h"
#include "testing/verdicts/render.h"

#include <algorithm>

namespace {

using namespace orb;

class AFewFiles final : public structured::Files {
public:
  std::optional<std::string> read(const std::string& path) override {
    if (path == "fuzz.bas")
      return "10 goroll 90,rnd 200,1\n20 macrun 40\n30 delay 30\n40 print \"side\", rnd 6\n";
    if (path == "m.macro")
      return ".macro wink id=40\nmarker 3\nrgb 255 0 0\n";
    if (path == "m.svg")
      return R"(<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200" viewBox="0 0 200 200">
<rect class="zone" id="goal" x="60" y="50" width="30" height="20"/>
<line class="wall" x1="10" y1="0" x2="10" y2="90"/></svg>)";
    return std::nullopt;
  }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  AFewFiles files;
  auto suite = testing::make_suite({{"fuzz.test", std::string(as_text({data, size}))}}, {}, files);
  if (!suite)
    __builtin_trap(); // only a name that was requested can be missing
  auto& file = suite->files.front().file;
  for (const auto& finding : file.diagnostics)
    if (finding.span.begin > finding.span.end || finding.span.end > size)
      __builtin_trap();
  if (suite->has_errors())
    return 0;
  constexpr std::size_t most_walls = 100; // with more the ball would take too long
  constexpr std::size_t most_runs = 3;
  for (auto& test : file.tests)
    test.bound = std::min<Duration>(test.bound, 50ms);
  testing::Results results{.cases = suite->cases, .shards = {}, .groups = {}, .missing = {}};
  for (const auto& group : suite->groups) {
    const auto& test = suite->test_of(group);
    if (results.groups.size() == most_runs || test.stimuli.size() > most_walls)
      break;
    auto& told = results.groups.emplace_back();
    told.test = test.name.text;
    told.cases.push_back(testing::run_case(*suite, group, group.seeds.first, nullptr, nullptr));
  }
  for (const auto name : testing::format_names())
    testing::render(results, testing::format_called(name), testing::Listing::All, {});
  return 0;
}
