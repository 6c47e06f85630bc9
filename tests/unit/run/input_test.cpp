#include "run/input.h"

#include <gtest/gtest.h>

namespace orb::run {
namespace {

Input input_of(std::string name, std::string text) {
  structured::NoFiles files;
  auto input = read_input(std::move(name), std::move(text), "", {}, files);
  EXPECT_TRUE(input.has_value());
  return *std::move(input);
}

TEST(Input, IsCheckedOnceAndOnlyWhenSomebodyAsks) {
  for (const auto& [name, text] : {std::pair("a.bas", "10 goroll 400,90,1\n"),
                                   std::pair("a.macro", "rgb 1 2 3\nrgb 4 5 6\n")}) {
    const auto input = input_of(name, text);
    EXPECT_FALSE(input.has_errors()) << name; // it may run, to show how it stops
    EXPECT_TRUE(input.checked->files.empty()) << name;
    const auto& found = findings(input);
    EXPECT_FALSE(found.front().diagnostics.empty()) << name;
    EXPECT_EQ(found.data(), findings(input).data()) << name;
  }
}

TEST(Input, ReadingTellsOnlyWhatKeepsItFromBeingBuilt) {
  const auto fine = input_of("a.orb", "x = 1\nprint \"a\"\n");
  EXPECT_FALSE(fine.has_errors());
  EXPECT_TRUE(fine.errors.front().diagnostics.empty());
  EXPECT_EQ(findings(fine).front().diagnostics.size(), 1U); // `x` is never read
  EXPECT_TRUE(input_of("a.orb", "print b\n").has_errors());
  EXPECT_TRUE(input_of("a.orb", "sub a\nend sub\n").has_errors()); // nothing to run
  EXPECT_TRUE(input_of("a.bas", "").has_errors());
  EXPECT_TRUE(input_of("a.macro", "rol 1, 2\n").has_errors());
}

} // namespace
} // namespace orb::run
