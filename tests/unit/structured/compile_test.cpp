#include "structured/compile.h"

#include "structured/text/rules.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace orb::structured {
namespace {

class MapFiles final : public Files {
public:
  std::optional<std::string> read(const std::string& path) override {
    const auto found = texts.find(path);
    return found == texts.end() ? std::nullopt : std::optional(found->second);
  }
  std::map<std::string, std::string> texts;
};

Compiled compiled(std::string_view text, compiler::Target target = {}) {
  NoFiles files;
  return compile("test.orb", "test.orb", text, target, files);
}

/// Returns the robot's lines, or the findings if there are errors.
std::string lines(std::string_view text) {
  const auto result = compiled(text);
  if (!result.has_errors())
    return result.robot.text;
  std::string findings;
  for (const auto& d : result.program.diagnostics)
    findings += fmt::format("{}: {}\n", d.rule->id, in_english(d.message));
  return findings;
}

std::string first_rule(const Compiled& result) {
  return result.program.diagnostics.empty()
             ? std::string()
             : std::string(result.program.diagnostics.front().rule->id);
}

// ---- what blocks become

TEST(Lines, AnIfOfOneStatementIsOneLine) {
  EXPECT_EQ(lines("if yaw > 90 then LEDC 1 else LEDC 2\n"),
            "1 if yaw > 90 then LEDC 1 else LEDC 2\n");
  EXPECT_EQ(lines("if yaw > 90 then\n  LEDC 1\nend if\n"), "1 if yaw > 90 then LEDC 1\n");
}

TEST(Lines, ComparisonsThatTheRobotLacks) {
  EXPECT_EQ(lines("if yaw <= 90 then LEDC 1\n"), "1 if yaw < 91 then LEDC 1\n");
  EXPECT_EQ(lines("if yaw >= 90 then LEDC 1\n"), "1 if yaw > 89 then LEDC 1\n");
  EXPECT_EQ(lines("if yaw >= 90 and not (speed <= 3) then LEDC 1\n"),
            "1 if yaw > 89 and speed > 3 then LEDC 1\n");
}

TEST(Lines, AnUnknownValueIsNotRaisedWhereThatCouldWrap) {
  EXPECT_EQ(lines("input x\ninput y\nif x <= y then LEDC 1\n"),
            "1 input X\n2 input Y\n3 if X < Y or X = Y then LEDC 1\n");
}

TEST(Lines, LoopsOfTheRobotWhereTheyFit) {
  EXPECT_EQ(lines("for i = 1 to 3\n  LEDC i\n  delay 1s\nnext i\n"),
            "1 for I = 1 to 3\n2 LEDC I\n3 delay 1000\n4 next I\n");
  EXPECT_EQ(lines("repeat 3\n  delay 1s\nend repeat\n"),
            "1 for A = 1 to 3\n2 delay 1000\n3 next A\n");
}

TEST(Lines, ALoopThatCannotRunIsGone) {
  EXPECT_EQ(lines("for i = 5 to 1\n  print i\nnext\nprint \"end\"\n"), "1 print \"end\"\n");
}

TEST(Lines, ALoopThatIsLeftKeepsNoFrame) {
  EXPECT_EQ(lines("for i = 1 to 9\n  delay 1s\n  if dshake then exit\nnext\nprint i\n").find("for"),
            std::string::npos);
}

TEST(Lines, ALoopThatIsLeftForElsewhereIsEndedThere) {
  const auto text = "loop\n  hit = 0\n  for t = 1 to 9\n    delay 1s\n    if yaw > 90 then\n"
                    "      hit = 1\n      exit\n    end if\n    print t\n  next t\n"
                    "  if hit then\n    print \"hit\"\n    RGB red\n  else\n    print \"none\"\n"
                    "    RGB blue\n  end if\nend loop\n";
  EXPECT_EQ(lines(text),
            "1 for T = 1 to 9\n2 delay 1000\n3 if yaw > 90 then goto 9\n4 print T\n5 next T\n"
            "6 print \"none\"\n7 RGB 0,0,255\n8 goto 1\n9 T = 9\n10 next T\n11 print \"hit\"\n"
            "12 RGB 255,0,0\n13 goto 1\n");
  EXPECT_TRUE(compiled(text).program.diagnostics.empty()); // no loop is left open
}

TEST(Lines, ALoopWhoseCounterIsNeededWhereItIsLeftIsNone) {
  EXPECT_EQ(lines("for i = 1 to 9\n  delay 1s\n  if yaw > 90 then exit\nnext i\nprint i\n"),
            "1 I = 1\n2 delay 1000\n3 if yaw > 90 then goto 6\n4 I = I + 1\n"
            "5 if I < 10 then goto 2\n6 print I\n");
}

/// Returns a program with a function that is too long to be inlined and reads an array `a` of four
/// elements.
std::string with_peak(std::string_view program) {
  return "array a[4]\narray b[4]\nfunction peak(n)\n  local best\n  for i = 1 to n\n"
         "    best = max(best, a[i])\n  next i\n  return best\nend function\n" +
         std::string(program);
}

std::size_t count_of(const std::string& text, const std::string& word);

TEST(Lines, ACallWhoseResultIsThereIsNotMadeAgain) {
  const auto calls = [](std::string_view program) {
    return count_of(lines(with_peak(program)), "gosub");
  };
  EXPECT_EQ(calls("input x\nprint peak(x)\nprint yaw, peak(x)\na[2] = yaw\nprint peak(x)\n"), 2U);
  // Only another array is written, and both paths of a test keep the result.
  EXPECT_EQ(calls("input x\nprint peak(x)\nb[2] = yaw\nif yaw > 3 then LEDC 1\nprint peak(x)\n"
                  "a[1] = 1\nprint peak(x), b[rnd(4)]\n"),
            2U);
  // One path changes the argument; then another variable holds the result.
  EXPECT_EQ(calls("input x\nprint peak(x)\nif yaw > 3 then x = 2\nprint peak(x)\n"), 2U);
  EXPECT_EQ(calls("input x\nk = peak(x)\nk += peak(x - 1)\nprint k + peak(x)\n"), 3U);
}

TEST(Lines, WhatIsSetOnEveryWayIsNotSetAgain) {
  EXPECT_EQ(lines("array a[9]\nfor i = 1 to 8\n  a[i + 1] = 1\n  if yaw > 3 then LEDC 1\n"
                  "  a[i + 1] += 2\n  print a[i + 1]\nnext i\n"),
            "1 for I = 1 to 8\n2 Y = I + 1\n3 Z = 1\n4 if yaw > 3 then LEDC 1\n5 Z = Z + 2\n"
            "6 print Z\n7 next I\n");
  EXPECT_EQ(lines("input x\nc = x * 2\nif yaw > 3 then c += 1\nLEDC c\nc = x * 2\nprint c, c\n"),
            "1 input X\n2 C = X * 2\n3 if yaw > 3 then C = C + 1\n4 LEDC C\n5 C = X * 2\n"
            "6 print C, C\n");
}

TEST(Lines, ACallThatSensesIsMadeAgain) {
  EXPECT_EQ(
      count_of(lines("function far(n)\n  local s\n  while s * s < n\n    s += abs(yaw) % 7 + 1\n"
                     "  end while\n  return s\nend function\ninput x\nprint far(x)\n"
                     "print far(x)\nprint far(x)\n"),
               "gosub"),
      3U);
}

TEST(Lines, AWhileIsTestedAtItsEnd) {
  EXPECT_EQ(lines("while accelone > 300\nend while\n"), "1 if accelone > 300 then goto 1\n");
  EXPECT_EQ(lines("while speed > 3\n  delay 50\nend while\n"),
            "1 goto 3\n2 delay 50\n3 if speed > 3 then goto 2\n");
}

TEST(Lines, ASelectOfNeighboursIsOn) {
  EXPECT_EQ(
      lines("select Sbatt\n  case 1\n    LEDC 1\n  case 2\n    LEDC 2\n  case 3, 4\n    LEDC 3\n"
            "end select\n"),
      "1 on Sbatt goto 2,4,6,6\n2 LEDC 1\n3 end\n4 LEDC 2\n5 end\n6 LEDC 3\n");
}

TEST(Lines, FunctionsGoWhereTheyAreUsed) {
  EXPECT_EQ(lines("function twice(n)\n  return n * 2\nend function\nprint twice(yaw) + 1\n"),
            "1 print yaw * 2 + 1\n");
}

TEST(Lines, UnusedSubsAndDeadCodeCostNothing) {
  EXPECT_EQ(lines("const debug = 0\nsub unused\n  print \"never\"\nend sub\n"
                  "if debug then print \"debug\"\nprint \"a\"\nend\nprint \"b\"\n"),
            "1 print \"a\"\n");
}

TEST(Lines, ClearingSensorsAreReadAsOftenAsTheProgramSays) {
  EXPECT_EQ(lines("x = dshake\nif x and yaw > 3 then print x\n"),
            "1 if dshake ! 0 and yaw > 3 then print 1\n");
  EXPECT_EQ(lines("if yaw > 3 and dshake then print 1\n"),
            "1 if yaw < 4 then goto 3\n2 if dshake ! 0 then print 1\n3 end\n");
}

TEST(Lines, ATestThatIsSafeOnlyBehindAnotherIsNotJoinedToIt) {
  // The robot always computes both sides of its `and` and `or`.
  EXPECT_EQ(lines("input x\nif x > 0 and 100 / x > 3 then LEDC 1\n"),
            "1 input X\n2 if X < 1 then goto 4\n3 if 100 / X > 3 then LEDC 1\n4 end\n");
  EXPECT_EQ(lines("input x\nif x < 0 or x > 31 or 1 { x > 9 then LEDC 1 else LEDC 2\n")
                .find("X > 31 or 1"),
            std::string::npos);
  EXPECT_EQ(lines("input x\nif x >= 0 and sqrt(x) > 9 then LEDC 1\n").find("and"),
            std::string::npos);
  EXPECT_EQ(lines("input x\ninput y\nif y > 0 and 100 / (x & 7 + 1) > 20 then LEDC 1\n"),
            "1 input X\n2 input Y\n3 if Y > 0 and 100 / (X & 7 + 1) > 20 then LEDC 1\n");
}

TEST(Lines, WhatIsComputedEarlyTakesAlongWhatStandsBeforeIt) {
  // The division must come before the element, and the first sensor before the division.
  EXPECT_EQ(lines("array a[3]\na[1] = speed\nprint (dshake & 1) + (7 / dshake) * a[rnd(3)]\n"),
            "1 Y = 1\n2 Z = speed\n3 B = dshake & 1\n4 A = 7 / dshake\n5 Y = rnd 3\n"
            "6 print B + A * Z\n");
}

TEST(Lines, AChoiceThatIsKnownIsNoChoice) {
  EXPECT_EQ(lines("select 1\n  case 1\n    LEDC 1\n  case 2\n    LEDC 2\n  case 3\n    LEDC 3\n"
                  "end select\nLEDC 4\n"),
            "1 LEDC 1\n2 LEDC 4\n");
}

TEST(Lines, AnIndexThatCanOnlyBeWrongIsAnError) {
  EXPECT_EQ(lines("array a[4]\ni = 7\na[i] = 3\nprint a[1]\n"),
            "array-index: `a` has elements 1 to 4, found 7\n");
  EXPECT_EQ(lines("array a[4]\narray b[3]\nfor i = 5 to 9\n  b[i] = 1\nnext i\nprint a[1], b[1]\n"),
            "array-index: `b` has elements 1 to 3, but the index is never one of them\n");
  EXPECT_EQ(lines("array a[4]\narray b[3]\ni = 0\nb[i] = 1\nprint a[1], b[1]\n"),
            "array-index: `b` has elements 1 to 3, found 0\n");
}

TEST(Lines, AnIndexThatIsRightSomewhereIsNoError) {
  const std::string text = "array a[4]\nset(2)\nset(7)\nprint a[1]\n"
                           "sub set(i)\n  a[i] = 3\nend sub\n";
  EXPECT_FALSE(compiled(text).has_errors());
  EXPECT_FALSE(
      compiled("array a[4]\ni = 7\nif yaw > 3 then i = 2\na[i] = 3\nprint a[1]\n").has_errors());
}

TEST(Lines, AWrongIndexIsMadeOneThatTheRobotRefuses) {
  EXPECT_EQ(lines("array a[4]\ni = rnd(9)\na[i] = 3\nprint a[1]\n"),
            "1 Y = rnd 9\n2 if Y > 4 then Y = 0\n3 Z = 3\n4 Y = 1\n5 print Z\n");
}

TEST(Lines, CopiesThatNeverDifferAreOneVariable) {
  // The function's counter is also its result, and is tested afterwards.
  EXPECT_EQ(lines("function throws()\n  local n\n  repeat\n    n += 1\n"
                  "    if dshake then return 0\n  until rnd(6) = 6\n  return n\nend function\n"
                  "loop\n  print throws()\nend loop\n"),
            "1 N = 0\n2 N = N + 1\n3 if dshake = 0 then goto 6\n4 N = 0\n5 goto 7\n6 if rnd 6 ! 6 "
            "then goto 2\n7 print N\n8 goto 1\n");
}

TEST(Lines, ACallWithAKnownValueThatDoesLittleIsNone) {
  EXPECT_EQ(lines("sub show(s)\n  select s\n    case 0\n      LEDC 1\n    case 1\n      LEDC 2\n"
                  "    else\n      LEDC 3\n  end select\nend sub\n"
                  "for i = 0 to 9\n  show(rnd(3) - 1)\nnext i\nshow(1)\n"),
            "1 for I = 0 to 9\n2 S = (rnd 3) - 1\n3 if S ! 0 then LEDC S + 1 else LEDC 1\n4 next "
            "I\n5 LEDC 2\n");
}

TEST(Lines, WhatFollowsFromATestedValueIsComputed) {
  EXPECT_EQ(lines("loop\n  u = rnd(2)\n  print u\n  if u = 1 then backLED 255 else backLED 0\n"
                  "end loop\n"),
            "1 U = rnd 2\n2 print U\n3 backLED 510 - U * 255\n4 goto 1\n");
  EXPECT_EQ(lines("loop\n  u = rnd(2) - 1\n  print u\n  if u = 1 then n += 5\n  print n\n"
                  "end loop\n"),
            "1 U = (rnd 2) - 1\n2 print U\n3 N = N + U * 5\n4 print N\n5 goto 1\n");
  // A test that clears what it reads is kept even if both branches do the same.
  EXPECT_EQ(lines("data 1, 2\nif 8 <> 1 + dshake then read c else read c\nprint c\n"),
            "1 data 1,2\n2 if 1 + dshake = 8 then goto 3\n3 read C\n4 print C\n");
}

TEST(Lines, ArmsOfTwoLinesShareTheirTest) {
  EXPECT_EQ(lines("loop\n  input a\n  if a < 5 then\n    LEDC 1\n    print \"low\"\n  else\n"
                  "    LEDC 2\n    print \"high\"\n  end if\nend loop\n"),
            "1 input A\n2 if A < 5 then LEDC 1 else LEDC 2\n"
            "3 if A < 5 then print \"low\" else print \"high\"\n4 goto 1\n");
  // The first line changes the tested variable, so the test cannot be repeated for the second.
  EXPECT_EQ(lines("input a\nif a < 5 then\n  a = 9\n  print \"low\"\nelse\n  a = 3\n"
                  "  print \"high\"\nend if\nprint a\n"),
            "1 input A\n2 if A > 4 then goto 6\n3 A = 9\n4 print \"low\"\n5 goto 8\n6 A = 3\n"
            "7 print \"high\"\n8 print A\n");
}

TEST(Lines, ACallLeadsToTheTestOfALoopThatASubBeginsWith) {
  EXPECT_EQ(lines("sub count(n)\n  while n > 0\n    print n\n    delay 50\n    RGB n, 0, n\n"
                  "    n -= 1\n  end while\nend sub\nfor i = 1 to 9\n  count(i)\n"
                  "  count(i / 2)\nnext i\n"),
            "1 for I = 1 to 9\n2 N = I\n3 gosub 12\n4 N = I / 2\n5 gosub 12\n6 next I\n7 end\n"
            "8 print N\n9 delay 50\n10 RGB N,0,N\n11 N = N - 1\n"
            "12 if N > 0 then goto 8 else return\n");
}

TEST(Lines, AnElementThatIsSetToItselfStays) {
  EXPECT_EQ(lines("array a[2]\nfor i = 1 to 2\n  a[i] = rnd(6)\n  a[i] = a[i]\n  print a[i]\n"
                  "next i\n"),
            "1 for Y = 1 to 2\n2 Z = rnd 6\n3 print Z\n4 next Y\n");
}

TEST(Lines, AnElementThatStaysIsReadWhereItIsNeeded) {
  EXPECT_EQ(lines("array a[3]\nfor i = 1 to 3\n  a[i] = rnd(60)\n  n = 0\n  most = a[i]\n"
                  "  repeat\n    n += rnd(6)\n  until n > most\n  print n\nnext i\n"),
            "1 for Y = 1 to 3\n2 Z = rnd 60\n3 N = 0\n4 N = N + rnd 6\n5 if N < Z + 1 then goto "
            "4\n6 print N\n7 next Y\n");
}

TEST(Lines, AnIndexIsComputedAgainRatherThanKept) {
  EXPECT_EQ(
      lines("array a[9]\ninput i, 0, 1\nif i > 8 or i < 1 then end\n"
            "a[i] = rnd(9)\nt = a[i]\na[i] = a[i + 1]\na[i + 1] = t\nprint a[3]\n"),
      "1 input I,0,1\n2 if I < 9 and I > 0 then goto 4\n3 end\n4 Y = I\n5 Z = rnd 9\n6 B = Z\n7 Y "
      "= I + 1\n8 A = Z\n9 Y = I\n10 Z = A\n11 Y = I + 1\n12 Z = B\n13 Y = 3\n14 print Z\n");
}

TEST(Lines, AnArgumentIsOneOfTwoInOneLine) {
  EXPECT_EQ(lines("sub go(h)\n  goroll h, 70, 1\n  delay 700ms\nend sub\n"
                  "loop\n  if yaw > 180 then go(90) else go(225)\nend loop\n"),
            "1 if yaw > 180 then H = 90 else H = 225\n2 goroll H,70,1\n3 delay 700\n4 goto 1\n");
}

TEST(Lines, ASensorIsReadTwiceInOneLine) {
  EXPECT_EQ(
      lines("repeat\n  t = max(abs(pitch), abs(roll))\n  LEDC t\nuntil t > 9\n"),
      "1 B = abs pitch\n2 if B < abs roll then B = abs roll\n3 LEDC B\n4 if B < 10 then goto 1\n");
  // Values that are needed later are read once.
  EXPECT_EQ(lines("a = abs(pitch)\nb = abs(roll)\nif a < b then a = b\nprint a\nprint b\n"),
            "1 A = abs pitch\n2 B = abs roll\n3 if A < B then A = B\n4 print A\n5 print B\n");
}

// ---- kept variables

std::string lines_keeping(std::string_view text, const std::vector<std::string>& kept) {
  NoFiles files;
  return compile("test.orb", "test.orb", text, {}, files, kept).robot.text;
}

TEST(Kept, EveryValueIsStored) {
  const std::string_view text = "lap = 5\ndelay 1s\nlap += 1\nprint lap\n";
  EXPECT_EQ(lines(text), "1 delay 1000\n2 print 6\n");
  EXPECT_EQ(lines_keeping(text, {"LAP"}), "1 L = 5\n2 delay 1000\n3 L = 6\n4 print 6\n");
}

TEST(Kept, NoOtherVariableHasItsLetter) {
  const std::string_view text = "a = rnd(9)\nprint a\nb = rnd(9)\nprint b, b\nprint b\n";
  NoFiles files;
  const auto result = compile("test.orb", "test.orb", text, {}, files, {"a"});
  EXPECT_EQ(letter_of(result, "A"), 0);
  EXPECT_NE(letter_of(result, "b"), 0);
  EXPECT_EQ(result.robot.text.find("3 A ="), std::string::npos) << result.robot.text;
}

TEST(Kept, WhatNothingSetsIsZero) {
  NoFiles files;
  const auto result =
      compile("test.orb", "test.orb", "print 1\nsub unused\n  x = 3\n  print x\nend sub\n", {},
              files, {"x"});
  EXPECT_TRUE(letter_of(result, "x").has_value());
  EXPECT_FALSE(letter_of(result, "y").has_value());
  EXPECT_EQ(result.robot.text, "1 print 1\n");
}

TEST(Lines, NegativeNumbersAreDifferences) {
  EXPECT_EQ(lines("locate -5, xpos + -3\n"), "1 locate 0-5,xpos - 3\n");
  EXPECT_EQ(lines("print xpos * -4\n"), "1 print xpos * (0-4)\n");
  EXPECT_EQ(lines("print -2147483648\n"), "1 print 0-2147483647-1\n");
}

TEST(Readable, TheMainProgramCanEndBehindTheSubs) {
  const auto text = "array s[8]\nsub push(v)\n  top += 1\n  s[top] = v\n  print top, v\n"
                    "  delay 50\nend sub\nwhile top < 6\n  input x\n  if x = 0 then end\n"
                    "  push(x)\n  push(-x)\nend while\nRGB red\nprint s[1]\n";
  EXPECT_NE(readable(compiled(text)).find("' sub push"), std::string::npos);
}

// ---- limits

TEST(Limits, DeepParenthesesGetTemporaries) {
  const auto text = lines("x = ((((((yaw + 1) * 2) + 1) * 2 + 1) * 2 + 1) * 2 + 1) * 2\nprint x\n");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(Lines, ALoopWhoseCounterIsSetInItCountsInOneVariable) {
  const auto text = lines("y = 0\nfor y = 0 to y\n  y = y\nnext y\nprint y\n");
  EXPECT_NE(text.find("for Y"), std::string::npos) << text;
  EXPECT_NE(text.find("next Y"), std::string::npos) << text;
}

TEST(Limits, AConstantThatIsDeeperThanItsVariableStaysAVariable) {
  // A negative number is printed in parentheses.
  EXPECT_EQ(lines("x = -8\nprint (abs(xpos & x) - 26) * 3\n"),
            "1 X = 0-8\n2 print ((abs (xpos & X)) - 26) * 3\n");
  EXPECT_EQ(lines("x = -8\nnull = 0\nprint (abs(xpos & x + null) - 26) * 3\n"),
            "1 X = 0-8\n2 print ((abs (xpos & X)) - 26) * 3\n");
}

TEST(Limits, AConstantWhoseFoldingIsTooDeepStandsAsItIs) {
  const auto text =
      lines("input y\na = yaw\nb = speed\nsense()\nprint a, b, y\n"
            "sub sense()\n  local v\n"
            "  input y, 5, 9 - a - (v + 1 / (sqrt(y) + 9 * (4 - b))) } (sqrt(a) - v * 8) - rnd(7)\n"
            "end sub\n");
  EXPECT_EQ(text.find('V'), std::string::npos) << text;
}

TEST(Limits, PrintsOf32And33Bytes) {
  EXPECT_EQ(lines("print \"12345678901234567890123456789012\"\n"),
            "1 print \"12345678901234567890123456789012\"\n");
  EXPECT_EQ(lines("print \"123456789012345678901234567890123\"\n"),
            "1 print \"12345678901234567890123456789012\";\n2 print \"3\"\n");
  EXPECT_EQ(lines("print \"1234567890123456789012345678\" yaw yaw\n"),
            "1 print \"1234567890123456789012345678\" yaw;\n2 print yaw\n");
}

/// Returns a program with `count` variables in use at once.
std::string many(int count, bool array) {
  std::string text = array ? "array list[3]\n" : "";
  for (int i = 0; i < count; ++i)
    text += fmt::format("input v{}\n", i);
  text += array ? "list[2] = 1\n" : "";
  for (int i = 0; i < count; ++i)
    text += fmt::format("print v{}\n", i);
  return text + (array ? "print list[2]\n" : "");
}

TEST(Limits, TwentyFiveVariablesAtOnce) {
  EXPECT_FALSE(compiled(many(24, true)).has_errors());
  EXPECT_FALSE(compiled(many(25, false)).has_errors());
  EXPECT_EQ(first_rule(compiled(many(25, true))), "too-many-variables");
  EXPECT_EQ(first_rule(compiled(many(26, false))), "too-many-variables");
}

TEST(Limits, AnyNumberOfVariablesOneAfterTheOther) {
  std::string text;
  for (int i = 0; i < 60; ++i)
    text += fmt::format("input v{0}\nprint v{0} v{0}\n", i);
  EXPECT_FALSE(compiled(text).has_errors());
}

std::string nested_loops(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i)
    text += fmt::format("for i{} = 1 to 2\n", i);
  text += "delay 10\n";
  for (int i = 0; i < depth; ++i)
    text += "next\n";
  return text;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

TEST(Limits, FourLoopsOfTheRobotInsideEachOther) {
  EXPECT_EQ(count_of(lines(nested_loops(4)), "for "), 4U);
  EXPECT_EQ(count_of(lines(nested_loops(5)), "for "), 4U);
  EXPECT_EQ(count_of(lines(nested_loops(6)), "for "), 4U);
}

std::string nested_calls(int depth) {
  std::string text = "s0\ns0\n";
  for (int i = 0; i < depth; ++i) {
    text += fmt::format("sub s{}\n", i);
    for (int n = 0; n < 6; ++n)
      text += fmt::format("  print \"level {} line {}\"\n", i, n);
    if (i + 1 < depth)
      text += fmt::format("  s{0}\n  s{0}\n", i + 1);
    text += "end sub\n";
  }
  return text;
}

TEST(Limits, CallsDeeperThanFourAreWrittenIntoTheirCallers) {
  for (int depth = 3; depth <= 7; ++depth) {
    const auto result = compiled(nested_calls(depth));
    EXPECT_FALSE(result.has_errors()) << depth << ": " << first_rule(result);
  }
}

TEST(Limits, AProgramThatIsTooLargeNamesItsParts) {
  std::string text = "sub big(n)\n";
  for (int i = 0; i < 300; ++i)
    text += fmt::format("  RGB n, {}, {}\n  delay 20\n", i % 256, (i * 7) % 256);
  text += "end sub\nbig(1)\nbig(2)\n";
  const auto result = compiled(text);
  EXPECT_EQ(first_rule(result), "program-too-large");
  EXPECT_NE(in_english(result.program.diagnostics.front().help).find("`big`"), std::string::npos);
}

TEST(Lines, AMisspeltStatementIsNotTakenForACall) {
  EXPECT_EQ(lines("dealy 1s\n"), "unknown-name: `dealy` is neither a statement nor a sub\n");
  EXPECT_EQ(lines("patrol 3\n"),
            "malformed-line: the arguments of a call need parentheses, found `3`\n");
}

TEST(Targets, NewerWordsAreNamed) {
  compiler::Target target;
  target.version = spec::BasicVersion::V0_9;
  EXPECT_EQ(first_rule(compiled("goroll 0, 80, 1\n", target)), "newer-than-target");
  const auto old = compiled("x = -5\nprint x, -3\nprint x * -2\n", target);
  EXPECT_FALSE(old.has_errors()) << first_rule(old);
}

// ---- files

TEST(FilesOf, AnIncludeIsTakenOnceAndCountsFromItsFile) {
  MapFiles files;
  files.texts["lib/a.orb"] =
      "include \"b.orb\"\nsub blink(n)\n  LEDC n * step_of\n  delay 1s\nend sub\n";
  files.texts["lib/b.orb"] = "const step_of = 2\n";
  const auto result = compile(
      "main.orb", "main.orb",
      "include \"lib/a.orb\"\ninclude \"lib/b.orb\"\nblink(1)\nblink(step_of)\n", {}, files);
  EXPECT_FALSE(result.has_errors()) << first_rule(result);
  EXPECT_EQ(result.program.files.size(), 3U);
}

TEST(FilesOf, CirclesAndMissingFilesAreFindings) {
  MapFiles files;
  files.texts["a.orb"] = "include \"b.orb\"\n";
  files.texts["b.orb"] = "include \"a.orb\"\n";
  EXPECT_EQ(first_rule(compile("m", "m", "include \"a.orb\"\nprint 1\n", {}, files)),
            "include-cycle");
  EXPECT_EQ(first_rule(compile("m", "m", "include \"c.orb\"\nprint 1\n", {}, files)),
            "missing-file");
  files.texts["c.orb"] = "print 2\n";
  EXPECT_EQ(first_rule(compile("m", "m", "include \"c.orb\"\nprint 1\n", {}, files)),
            "included-statement");
}

TEST(FilesOf, AFileHasOnePath) {
  EXPECT_EQ(resolve_path("main.orb", "a.orb"), "a.orb");
  EXPECT_EQ(resolve_path("x/main.orb", "./lib/../a.orb"), "x/a.orb");
  EXPECT_EQ(resolve_path("x/main.orb", "../a.orb"), "a.orb");
  EXPECT_EQ(resolve_path("x/main.orb", "/lib/a.orb"), "/lib/a.orb");
}

TEST(FilesOf, VeryManyAreOneFinding) {
  MapFiles files;
  for (int i = 0; i < 100; ++i)
    files.texts[fmt::format("f{}.orb", i)] = fmt::format("include \"f{}.orb\"\n", i + 1);
  const auto result = compile("m", "m", "include \"f0.orb\"\nprint 1\n", {}, files);
  EXPECT_EQ(result.program.diagnostics.size(), 1U);
}

TEST(FilesOf, VeryManyOfOneFileAreOneFinding) {
  MapFiles files;
  std::string includes;
  std::string uses;
  for (int i = 0; i < 200; ++i) {
    files.texts[fmt::format("f{}.orb", i)] = fmt::format("const c{} = 1\n", i);
    files.texts[fmt::format("f{}.macro", i)] =
        fmt::format(".macro m{} id={}\ndelay 1\n", i, i + 32);
    includes += fmt::format("include \"f{}.orb\"\n", i);
    uses += fmt::format("use \"f{}.macro\"\n", i);
  }
  for (const auto& text : {includes, uses}) {
    const auto result = compile("m", "m", text + "print 1\n", {}, files);
    ASSERT_EQ(result.program.diagnostics.size(), 1U);
    EXPECT_EQ(result.program.diagnostics.front().rule, &rules::MissingFile);
  }
}

TEST(AnyBytes, AMarkBeforeTheTextIsNoPartOfIt) {
  EXPECT_EQ(lines("\xEF\xBB\xBFprint 1\n"), "1 print 1\n");
}

TEST(AnyBytes, SubsThatCallEachOtherVeryOftenAreTooLarge) {
  std::string text = "s0\n";
  for (int i = 0; i < 20; ++i) {
    text += fmt::format("sub s{}\n", i);
    for (int n = 0; n < 8; ++n)
      text += fmt::format("  s{}\n", i + 1);
    text += "end sub\n";
  }
  EXPECT_EQ(first_rule(compiled(text + "sub s20\n  print yaw\nend sub\n")), "program-too-large");
}

TEST(FilesOf, MacrosAreCalledByName) {
  MapFiles files;
  files.texts["wink.macro"] = ".macro wink id=40\nrgb 0 255 0\ndelay 100\n";
  const auto result = compile("m", "m", "use \"wink.macro\"\nmacrun wink\nprint wink\n", {}, files);
  EXPECT_EQ(result.robot.text, "1 macrun 40\n2 print 40\n") << first_rule(result);
  files.texts["bad.macro"] = "roll roll\n";
  EXPECT_EQ(first_rule(compile("m", "m", "use \"bad.macro\"\nprint 1\n", {}, files)),
            "bad-macro-file");
}

// ---- any bytes

void expect_quick(const std::string& text) {
  const auto begin = std::clock(); // processor time, as the machine may be busy
  const auto result = compiled(text);
  const auto took = (std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_LT(took, 5) << text.substr(0, 40);
  EXPECT_FALSE(result.program.diagnostics.empty()) << text.substr(0, 40);
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i)
    all += text;
  return all;
}

TEST(AnyBytes, AreBoundedInTime) {
  expect_quick("x = " + repeated("(", 60000) + "\n");
  expect_quick("if " + repeated("not ", 12000) + "1 then end\n");
  expect_quick("print " + repeated("1 + yaw + ", 6000) + "x\n");
  expect_quick(repeated("if yaw then\n", 5000));
  expect_quick(repeated("end while\n", 6000));
  expect_quick(repeated("goto a\n", 9000));
  expect_quick(repeated("a:\n", 20000));
  std::string names;
  for (int i = 0; i < 5000; ++i)
    names += fmt::format("input n{}\n", i);
  for (int i = 0; i < 400; ++i)
    names += fmt::format("print n{}\n", i);
  expect_quick(names.substr(0, 65000) + "\n");
  std::string subs = "s0\n";
  for (int i = 0; i < 1500; ++i)
    subs += fmt::format("sub s{}\ns{}\ns{}\nend sub\n", i, i + 1, i + 1);
  expect_quick(subs.substr(0, 65000));
}

} // namespace
} // namespace orb::structured
