#include "base/text/text.h"
#include "testing/verdicts/render.h"

#include <fmt/format.h>
#include <map>

namespace orb::testing {
namespace {

std::string seconds(Duration t) {
  return fmt::format("{:.3f}", std::chrono::duration<double>(t).count());
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

/// The failures of a case in a few words.
std::string short_story(const CaseResult& one) {
  if (one.omitted)
    return std::string(to_string(one.verdict));
  if (one.verdict == Verdict::Error)
    return first_line(one.problem);
  return fmt::format("{}: {}", one.misses.front().expected, in_english(one.misses.front().seen));
}

std::string test_case(const GroupResult& group, const CaseResult& one) {
  const auto name =
      group.count == 1 ? group.test : fmt::format("{}, seed {}", group.test, one.seed);
  auto out = fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{}\"",
                         escape_markup(group.program), escape_markup(name), seconds(one.lasted));
  if (one.verdict == Verdict::Passed)
    return out + "/>\n";
  const bool failed = one.verdict == Verdict::Failed;
  return out + fmt::format("><{0} message=\"{1}\" type=\"{2}\">{3}</{0}></testcase>\n",
                           failed ? "failure" : "error", escape_markup(short_story(one)),
                           failed ? "expectation" : "program", escape_markup(story(group, one)));
}

/// The results of one test file.
struct TestSuite {
  std::string cases;
  std::uint64_t count = 0;
  std::uint64_t failures = 0;
  std::uint64_t errors = 0;
  Duration lasted{};
};

/// One schema requires the element, the other requires a property in it.
constexpr std::string_view properties =
    "<properties><property name=\"clock\" value=\"robot time\"/></properties>\n";

} // namespace

std::string render_junit(const Results& results) {
  std::map<std::string, TestSuite> suites;
  std::vector<std::string> order;
  for (const auto& group : results.groups) {
    if (group.cases.empty())
      continue;
    if (!suites.contains(group.file))
      order.push_back(group.file);
    auto& suite = suites[group.file];
    for (const auto& one : group.cases) {
      suite.cases += test_case(group, one);
      ++suite.count;
      suite.failures += one.verdict == Verdict::Failed ? 1 : 0;
      suite.errors += one.verdict == Verdict::Error ? 1 : 0;
      suite.lasted += one.lasted;
    }
  }
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& suite = suites[order[i]];
    // A constant: the real time would make the bytes of equal results differ.
    out += fmt::format(
        "<testsuite name=\"{}\" package=\"orb\" id=\"{}\" timestamp=\"1970-01-01T00:00:00\" "
        "hostname=\"localhost\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
        "time=\"{}\">\n{}{}<system-out/>\n<system-err/>\n</testsuite>\n",
        escape_markup(order[i]), i, suite.count, suite.failures, suite.errors,
        seconds(suite.lasted), properties, suite.cases);
  }
  return out + "</testsuites>\n";
}

} // namespace orb::testing
