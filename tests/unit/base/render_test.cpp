#include "base/render.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb {
namespace {

constexpr Rule shout = {"shout", Severity::Warning, "a word is shouted", "", "A", "a", 2};

TEST(RenderText, MarksTheSpanUnderTheLine) {
  const Source source("a.bas", "10 end\n20 RGB 1\n");
  const auto text = render_text(
      source, finding(shout, {10, 13}, Message::as_is("loud"), Message::as_is("whisper")), Style{});
  EXPECT_EQ(text, "a.bas:2:4: warning[shout]: loud\n"
                  "  2 | 20 RGB 1\n"
                  "    |    ^~~\n"
                  "  help: whisper\n");
}

TEST(RenderText, CountsColumnsOfWhatIsShownNotBytes) {
  const Source source("a.bas", "é\xFFX");
  const auto text = render_text(source, finding(shout, {3, 4}, Message::as_is("loud")), Style{});
  EXPECT_EQ(text, "a.bas:1:4: warning[shout]: loud\n"
                  "  1 | é\xEF\xBF\xBDX\n"
                  "    |   ^\n");
}

TEST(RenderText, CutsLongLinesAroundTheCaret) {
  const Source source("a.bas", fmt::format("{:a>500}B{:c>500}", "", ""));
  const auto text =
      render_text(source, finding(shout, {500, 501}, Message::as_is("loud")), Style{});
  EXPECT_LT(text.size(), 400U);
  EXPECT_NE(text.find("aB"), std::string::npos);
}

TEST(RenderText, ASpanAtTheEndOfTheFileStillHasACaret) {
  const Source source("a.bas", "10");
  EXPECT_NE(render_text(source, finding(shout, {2, 2}, Message::as_is("m")), Style{}).find("^"),
            std::string::npos);
}

TEST(RenderText, ColoursOnlyWhenAsked) {
  const Source source("a.bas", "10");
  EXPECT_EQ(render_text(source, finding(shout, {0, 1}, Message::as_is("m")), {false}).find('\x1b'),
            std::string::npos);
  EXPECT_NE(render_text(source, finding(shout, {0, 1}, Message::as_is("m")), {true}).find('\x1b'),
            std::string::npos);
}

TEST(RenderGcc, IsOneLineAFinding) {
  const Source source("a.bas", "10 RGB");
  EXPECT_EQ(render_gcc(source, finding(shout, {3, 6}, Message::as_is("loud"))),
            "a.bas:1:4: warning: loud [shout]\n");
}

TEST(RenderSummary, CountsInWords) {
  const Source source("a.bas", "10 RGB");
  std::vector<FileFindings> files(2);
  files[0].source = files[1].source = &source;
  EXPECT_EQ(render_summary(files), "no findings in 2 files\n");
  files[0].diagnostics = {finding(shout, {0, 1}, Message::as_is("m"))};
  EXPECT_EQ(render_summary(files), "1 warning in 2 files\n");
}

} // namespace
} // namespace orb
