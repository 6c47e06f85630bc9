// The variables shown by a report, by name and place of change.

#include "run/run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace orb::run {
namespace {

class Nobody final : public Listener {
public:
  void on_event(Duration, const vm::Event&) override {}
  void on_fault(Duration, const ProgramError&) override {}
};

/// Returns `name:value,value…` of each variable that changed, in the order of the journey.
std::string named_changes(const std::string& name, const std::string& text) {
  structured::NoFiles files;
  std::vector<Input> inputs;
  auto input = read_input(name, text, "", {}, files);
  if (!input)
    return input.error().message;
  inputs.push_back(*std::move(input));
  Nobody nobody;
  report::Journey journey;
  if (const auto ending = run(inputs, {}, nobody, &journey); !ending)
    return ending.error().message;
  std::string out;
  for (const auto& variable : journey.variables()) {
    if (variable.values.empty())
      continue;
    out += fmt::format("{}{}{}:", out.empty() ? "" : " ", variable.name,
                       variable.owner.empty() ? "" : "/" + variable.owner);
    for (const auto& entry : variable.values.entries())
      out += fmt::format("{}{}", out.ends_with(':') ? "" : ",", entry.value);
  }
  return out;
}

TEST(NamedValues, AreTheLettersOfANumberedProgram) {
  EXPECT_EQ(named_changes("a.bas", "10 A=1\n20 for B=1 to 2\n30 A=A*5\n40 next B\n"
                                   "50 if A>9 then C=7 else C=8\n60 Y=3\n70 Z=A+1\n80 D=0\n"),
            "A:1,5,25 B:1,2,3 C:7 Y:3 Z[3]:26");
}

TEST(NamedValues, AreTheNamesOfAStructuredProgram) {
  EXPECT_EQ(named_changes("a.orb", "array seen[3]\nturns = 0\nsub leg(n)\n  local twice\n"
                                   "  twice = n * 2 + speed\n  seen[n] = twice\n  turns += twice\n"
                                   "end sub\nfor i = 1 to 3\n  leg(i)\nnext i\nleg(3)\n"
                                   "print turns, seen[2]\n"),
            // The last sum moves directly to its only reader, so no letter holds it.
            "i:1,2,3,4 twice/leg:2,4,6 n/leg:1,2,3 turns:2,6,12 seen[1]:2 seen[2]:4 seen[3]:6");
}

TEST(NamedValues, AreNoneOfAMacro) {
  EXPECT_EQ(named_changes("a.macro", "roll 0, 0\n"), "");
}

} // namespace
} // namespace orb::run
