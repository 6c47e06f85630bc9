#include "structured/layout/format.h"

#include "random_structured.h"
#include "structured/compile.h"
#include "structured/text/structured_words.h"

#include <gtest/gtest.h>

namespace orb::structured {
namespace {

std::string robot_lines(std::string_view text) {
  NoFiles files;
  return compile("test.orb", "test.orb", text, {}, files).robot.text;
}

/// Returns the same program, carelessly formatted: blanks missing or doubled, other case,
/// indentation and line ends. Quoted text stays.
std::string carelessly(std::string_view text, std::uint64_t seed) {
  Random random{seed};
  std::string out;
  bool quoted = false;
  for (const char c : text) {
    quoted = quoted != (c == '"');
    if (quoted)
      out += c;
    else if (c == ' ')
      out.append(1 + random.below(3), random.chance(0.2) ? '\t' : ' ');
    else if (c == '\n')
      out += random.chance(0.3) ? "\r\n\r\n\r\n" : random.chance(0.5) ? " \n   " : "\n";
    else if (c >= 'a' && c <= 'z' && random.chance(0.1))
      out += static_cast<char>(c - 'a' + 'A');
    else
      out += c;
  }
  return out;
}

TEST(Format, KeepsWhatProgramsDoAndIsDoneAtOnce) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto text = testing::RandomStructured(seed).write();
    const auto once = format(carelessly(text, seed));
    ASSERT_EQ(format(once), once) << "seed " << seed;
    ASSERT_EQ(robot_lines(once), robot_lines(text)) << "seed " << seed << ":\n" << once;
  }
}

TEST(Format, TakesAnyBytes) {
  Random random{1};
  for (int n = 0; n < 2000; ++n) {
    std::string text;
    for (auto size = random.below(60); size > 0; --size)
      text += "\n\r\t\"'(),:;#x5= if\x80"[random.below(19)];
    const auto once = format(text);
    ASSERT_EQ(format(once), once) << text;
  }
}

TEST(Words, ExamplesAreProgramsWithoutFindings) {
  NoFiles files;
  for (const auto* table : {keywords.data(), wider_words.data()}) {
    const auto size = table == keywords.data() ? keywords.size() : wider_words.size();
    for (const auto& row : std::span(table, size)) {
      EXPECT_FALSE(row.usage.empty() || row.summary.empty()) << row.word;
      if (row.example.empty())
        continue;
      const auto compiled = compile("test.orb", "test.orb", row.example, {}, files);
      for (const auto& found : compiled.program.diagnostics)
        EXPECT_EQ(found.severity, Severity::Info) << row.word << ": " << in_english(found.message);
      EXPECT_EQ(format(row.example), row.example) << row.word;
    }
  }
}

} // namespace
} // namespace orb::structured
