// The linter reports programs that run but not as intended, and is silent about correct ones. The
// programs are in intent/, numbered and structured.

#include "base/rules.h"
#include "compiler/check.h"
#include "structured/compile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace orb::structured {
namespace {

struct Sample {
  bool numbered = false;
  bool held_out = false;
  std::string rule; ///< expected to be found
  std::string text;
};

std::vector<Sample> read_samples(const std::string& name) {
  std::ifstream file(std::filesystem::path(ORB_INTENT) / name);
  std::vector<Sample> samples;
  bool held_out = false;
  for (std::string line; std::getline(file, line);) {
    if (line == "=== held out") {
      held_out = true;
    } else if (line.starts_with("=== ")) {
      std::istringstream words(line.substr(4));
      auto& sample = samples.emplace_back();
      std::string language;
      words >> language >> sample.rule;
      sample.numbered = language == "bas";
      sample.held_out = held_out;
    } else if (!samples.empty()) {
      samples.back().text += line + '\n';
    }
  }
  return samples;
}

std::vector<Diagnostic> findings_of(const Sample& sample) {
  if (sample.numbered)
    return compiler::check(sample.text, {}).diagnostics;
  NoFiles files;
  return compile("sample.orb", "sample.orb", sample.text, {}, files).program.diagnostics;
}

TEST(Intent, NothingIsSaidOfProgramsThatAreMeantSo) {
  const auto samples = read_samples("clean.txt");
  EXPECT_GE(samples.size(), 60U);
  for (const auto& sample : samples)
    for (const auto& d : findings_of(sample))
      if (d.severity != Severity::Info)
        ADD_FAILURE() << sample.text << d.rule->id << ": " << in_english(d.message);
}

TEST(Intent, MistakesAreNamed) {
  const auto samples = read_samples("mistakes.txt");
  EXPECT_GE(samples.size(), 70U);
  std::size_t missed_held_out = 0;
  for (const auto& sample : samples) {
    const auto found = findings_of(sample);
    const bool named = std::any_of(found.begin(), found.end(),
                                   [&](const Diagnostic& d) { return d.rule->id == sample.rule; });
    if (sample.held_out)
      missed_held_out += named ? 0 : 1;
    else
      EXPECT_TRUE(named) << sample.rule << "\n" << sample.text;
    for (const auto& d : found)
      EXPECT_TRUE(d.rule->id != sample.rule || !d.help.empty()) << sample.rule << "\n"
                                                                << sample.text;
  }
  EXPECT_LE(missed_held_out, 4U);
}

} // namespace
} // namespace orb::structured
