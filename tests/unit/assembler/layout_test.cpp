#include "assembler/text/layout.h"

#include "assembler/assemble.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::assembler {
namespace {

TEST(Layout, IndentsMacrosAndLoops) {
  EXPECT_EQ(layout("# a dance\r\n.macro   dance id = 40\r\nloop_start 3 # thrice\n"
                   "   rgb   255 ,0,  0 delay = 100ms\nloop_end\n\n\n\t# the end\nend  \n\n"),
            "# a dance\n.macro dance id=40\n  loop_start 3  # thrice\n"
            "    rgb 255, 0, 0 delay=100ms\n  loop_end\n\n  # the end\n  end\n");
}

TEST(Layout, LeavesTextsAlone) {
  EXPECT_EQ(layout("comment  \"a  #  , = \\\" b\"   # remark"),
            "comment \"a  #  , = \\\" b\"  # remark\n");
}

TEST(Layout, PutsBlanksAroundTheEqualsOfAConstant) {
  EXPECT_EQ(layout("  .const fast=200"), ".const fast = 200\n");
  EXPECT_EQ(layout(".const  fast  =  200"), ".const fast = 200\n");
}

TEST(Layout, OfNothingIsNothing) {
  EXPECT_EQ(layout(""), "");
  EXPECT_EQ(layout("\n \r\n\n"), "");
}

/// Pieces whose random lines often assemble, and some that never do.
rc::Gen<std::string> source() {
  const auto piece = rc::gen::element<std::string>(
      "roll", "rgb", "delay", "loop_start", "loop_end", "comment", "goto", ".macro", ".const",
      ".noend", ".raw", " ", "  ", "\t", ",", "=", "id", "delay", "128", "90", "0x1F", "200ms", "a",
      "\"x # y\"", "\"", "\\", "#", "\n", "\r\n", "\r", "-5", "1.5s", "end\n", "marker 20\n",
      "roll 1, 2\n");
  return rc::gen::map(rc::gen::container<std::vector<std::string>>(piece),
                      [](const std::vector<std::string>& pieces) {
                        std::string text;
                        for (const auto& one : pieces)
                          text += one;
                        return text;
                      });
}

RC_GTEST_PROP(Layout, IsDoneOnce, ()) {
  const auto text = layout(*source());
  RC_ASSERT(layout(text) == text);
}

RC_GTEST_PROP(Layout, KeepsTheBytes, ()) {
  const auto text = *source();
  const auto before = assemble(Source("a", text));
  const auto after = assemble(Source("a", layout(text)));
  RC_ASSERT(after.has_errors() == before.has_errors());
  if (before.has_errors())
    return;
  RC_ASSERT(after.macros.size() == before.macros.size());
  for (std::size_t i = 0; i < before.macros.size(); ++i)
    RC_ASSERT(after.macros[i].body == before.macros[i].body);
}

} // namespace
} // namespace orb::assembler
