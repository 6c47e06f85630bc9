#include "serve/control.h"

#include <gtest/gtest.h>

namespace orb::serve {
namespace {

Control read(std::string_view line, int balls = 1) {
  const auto control = parse_control(line, balls);
  EXPECT_TRUE(control) << line << ": " << (control ? "" : control.error());
  EXPECT_TRUE(control && *control) << line;
  return control && *control ? **control : Control{};
}

TEST(Control, IsAStimulusNowOrLater) {
  for (const auto* line : {"shake", "  shake", "at now shake", "shake # now"})
    EXPECT_TRUE(std::holds_alternative<Control::Now>(read(line).what)) << line;
  const auto later = read("at 2.5s push 90 120");
  ASSERT_TRUE(std::holds_alternative<vm::TimedStimulus>(later.what));
  EXPECT_EQ(std::get<vm::TimedStimulus>(later.what).at, 2500ms);
}

TEST(Control, IsForOneBallOrForAll) {
  EXPECT_EQ(read("3 state", 3).ball, 3);
  EXPECT_EQ(read("state", 3).ball, std::nullopt);
  EXPECT_TRUE(std::holds_alternative<Control::StateQuery>(read("state").what));
  EXPECT_TRUE(std::holds_alternative<Control::Reset>(read("1 reset").what));
}

TEST(Control, SkipsWhatAsksNothing) {
  for (const auto* line : {"", "  ", "# shake", "\t# shake"}) {
    const auto control = parse_control(line, 1);
    ASSERT_TRUE(control) << line;
    EXPECT_FALSE(*control) << line;
  }
}

TEST(Control, SaysWhatToWriteInstead) {
  struct {
    const char* line;
    const char* said;
  } constexpr rows[] = {
      {"shak", "`shak` is nothing that can be asked; did you mean `shake`?"},
      {"statt", "`statt` is nothing that can be asked; did you mean `state`?"},
      {"2s shake", "a time without `at`: `2s`; write `at 2s shake`"},
      {"at shake", "`at` takes a time and an event; write it like `at 2.5s shake`"},
      {"at now", "`at` takes a time and an event; write it like `at 2.5s shake`"},
      {"push 90", "missing strength: expected 0 to 255"},
      {"reset it", "`reset` takes no values; write `reset`"},
      {"4 shake", "there is no ball 4; the balls are 1 to 3"},
      {"0 shake", "there is no ball 0; the balls are 1 to 3"},
      {"2", "write what is asked of ball 2, as in `2 state`"},
  };
  for (const auto& row : rows) {
    const auto control = parse_control(row.line, 3);
    ASSERT_FALSE(control) << row.line;
    EXPECT_EQ(control.error(), row.said) << row.line;
  }
}

} // namespace
} // namespace orb::serve
