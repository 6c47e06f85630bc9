#include "basic_run.h"

#include <gtest/gtest.h>

namespace orb::vm {
namespace {

/// A program, its output and its end. The engines must agree on each.
struct Case {
  const char* name;
  const char* text;
  const char* printed;
  const char* end;
};

void PrintTo(const Case& test, std::ostream* out) {
  *out << test.name;
}

const Case cases[] = {
    {"precedence", "10 print 1+2&3, 2|1*4, 6&3+1, 10-3-2, 45|85, (2+3)*5\n", "3 6 3 5 125 25\n",
     "end"},
    {"truncation", "10 ? 7/2, (0-7)/2, 7%3, (0-7)%3, -7/2\n", "3 -3 1 -1 -3\n", "end"},
    {"division by constants", "10 A=-7\n20 ? A/2, A%2, A/7, A%7, A/10, A/2147483647\n",
     "-3 -1 -1 0 0 0\n", "end"},
    {"least number", "10 A=-2147483647-1\n20 ? A/2, A%10\n30 ? A/-1, A%-1, abs A\n",
     "-1073741824 -8\n-2147483648 0 -2147483648\n", "end"},
    {"wrapping", "10 A=2147483647\n20 A=A+1\n30 ? A\n40 ? A*2\n", "-2147483648\n0\n", "end"},
    {"shifts", "10 ? 3{2, 20}2, -8}1\n20 A=32\n30 ? 1{A\n", "12 5 -4\n",
     "Line 30: Bad numeric parameter"},
    {"functions take the whole rest", "10 A=8\n20 ? sqrt A+1\n30 ? 2*sqrt A+1\n40 ? abs 3-5\n",
     "3\n6\n2\n", "end"},
    {"square roots truncate", "10 ? sqrt 600000, sqrt 2147483647\n20 ? sqrt 0-1\n", "774 46340\n",
     "Line 20: Bad numeric parameter"},
    {"rnd of nothing", "10 A=rnd 0\n", "", "Line 10: Bad numeric parameter"},
    {"print separators", "10 ? \"a\" 1 \"b\",2,\n20 ? \"x\";\n30 ? $65 $(60+6)\n", "a1b 2 \nxAB\n",
     "end"},
    {"print at most 32 bytes",
     "10 ? \"12345678901234567890123456789012\"\n"
     "20 ? \"123456789012345678901234567890123\";\n",
     "12345678901234567890123456789012\n(print exceeds 32 bytes)\n", "end"},
    {"for counts",
     "10 for X=1 to 5 step 2\n20 ? X;\n30 next X\n40 for Y=10 to 3 step -3\n"
     "50 ? Y;\n60 next Y\n70 ? X,Y\n",
     "13510747 1\n", "end"},
    {"for runs once", "10 for X=5 to 1\n20 ? X\n30 next X\n40 ? X\n", "5\n6\n", "end"},
    {"for evaluates once", "10 X=3\n20 for X=1 to X\n30 ? X\n40 next X\n", "1\n", "end"},
    {"step zero", "10 for X=1 to 2 step 0\n", "", "Line 10: Bad STEP value"},
    {"five loops",
     "10 for A=1 to 2\n20 for B=1 to 2\n30 for C=1 to 2\n40 for D=1 to 2\n"
     "50 for E=1 to 2\n",
     "", "Line 50: FOR depth exceeded"},
    {"a loop may begin again",
     "10 A=0\n20 for X=1 to 9\n30 A=A+1\n40 if A<9 then goto 20\n"
     "50 ? A\n",
     "9\n", "end"},
    {"next of another loop", "10 for A=1 to 2\n20 for B=1 to 2\n30 next A\n", "",
     "Line 30: NEXT without FOR"},
    {"next without for", "10 next X\n", "", "Line 10: NEXT without FOR"},
    {"loop in Z", "10 Y=2\n20 for Z=1 to 3\n30 ? Z;\n40 next Z\n50 ? Z\n", "1234\n", "end"},
    {"gosub", "10 gosub 100\n20 ? \"b\"\n30 end\n100 ? \"a\"\n110 return\n", "a\nb\n", "end"},
    {"gosub too deep", "10 A=A+1\n20 ? A;\n30 gosub 10\n", "12345",
     "Line 30: GOSUB depth exceeded"},
    {"return without gosub", "10 return\n", "", "Line 10: RETURN without GOSUB"},
    {"on goto", "10 A=2\n20 on A goto 100,200\n100 ? 1\n200 ? 2\n210 on A+1 goto 100,200\n", "2\n",
     "Line 210: Illegal index"},
    {"on gosub", "10 on 2 gosub 100,200\n20 end\n100 ? 1\n110 return\n200 ? 2\n210 return\n", "2\n",
     "end"},
    {"on of nothing", "10 on 0 goto 10\n", "", "Line 10: Illegal index"},
    {"on to a missing line", "10 on 1 goto 30,10\n", "", "Line 10: Bad line number"},
    {"goto nowhere", "10 if 1=1 then goto 99\n", "", "Line 10: Bad line number"},
    {"Z needs Y", "10 A=Z\n", "", "Line 10: Illegal index"},
    {"Z out of bounds", "10 Y=26\n20 Z=1\n", "", "Line 20: Illegal index"},
    {"Z holds 25", "10 for Y=1 to 25\n20 Z=Y*Y\n30 next Y\n40 Y=5\n50 A=Z\n60 Y=25\n70 ? A,Z\n",
     "25 625\n", "end"},
    {"indices",
     "10 J=3\n20 Y=J\n30 Z=J\n40 Y=J-1\n50 Z=7\n60 Y=J+0\n70 A=Z\n80 Y=2\n90 Y=Z\n"
     "100 ? A,Y\n",
     "3 7\n", "end"},
    {"an index stores the new Y", "10 Y=4\n20 Z=Y\n30 ? Z\n", "4\n", "end"},
    {"an index faults in its second line", "10 Y=30\n20 A=Z\n", "", "Line 20: Illegal index"},
    {"and, or",
     "10 A=3\n20 if A>1 and A<5 then ? \"in\" else ? \"out\"\n"
     "30 if A>1 and A<3 then ? \"in\" else ? \"out\"\n"
     "40 if A=1 or A=3 then ? \"or\"\n50 if A=1 or A=2 then ? \"no\"\n",
     "in\nout\nor\n", "end"},
    {"only the branch taken can fault", "10 if 1=2 then foo else ? \"ok\"\n20 if 1=1 then foo\n",
     "ok\n", "Line 20: Unknown statement"},
    {"the condition comes first", "10 if 1/0=1 then foo\n", "", "Line 10: Divide by zero"},
    {"malformed lines wait", "10 ? 1\n20 rgb 1,2,3\n", "1\n", "Line 20: Unknown statement"},
    {"syntax error", "10 A=\n", "", "Line 10: Syntax error"},
    {"four levels", "10 ? ((((1))))\n20 ? (((((1)))))\n", "1\n", "Line 20: Expression too complex"},
    {"left of what is too deep happens first", "10 ? 1/0+(((((1)))))\n", "",
     "Line 10: Divide by zero"},
    {"faults in the order of the text", "10 ? Z+1/0\n", "", "Line 10: Illegal index"},
    {"division before Z", "10 ? 1/A+Z\n", "", "Line 10: Divide by zero"},
    {"data",
     "10 data 10,20,30\n20 read A,B\n30 rstr\n40 read C\n50 print A,B,C\n60 data 100\n"
     "70 read A\n80 print A,B,C\n90 read A\n",
     "10 20 10\n100 20 10\n", "Line 90: Out of data"},
    {"read into Z by the Y just read", "10 data 3,42\n20 read Y,Z\n30 Y=3\n40 ? Z\n", "42\n",
     "end"},
    {"tron",
     "10 print \"at line 10\"\n20 tron\n30 ? \"at line 30\"\n40 ? \"and now, 40\"\n"
     "50 troff\n60 ? 1\n",
     "at line 10\n<30>at line 30\n<40>and now, 40\n<50>1\n", "end"},
    {"lines without statement", "10\n20 ? 1\n30 'x\n40 goto 60\n50 ? 2\n60\n70 ? 3\n", "1\n3\n",
     "end"},
    {"unsorted", "20 ? 2\n10 ? 1\n", "2\n1\n", "end"},
    {"duplicates", "10 goto 30\n30 ? 1\n30 ? 2\n", "1\n2\n", "end"},
    {"timers only in range", "10 timerA=65536\n", "", "Line 10: Bad numeric parameter"},
    {"delay only in range", "10 delay 0-1\n", "", "Line 10: Bad numeric parameter"},
    {"arguments only in range", "10 goroll 360,0,0\n", "", "Line 10: Bad numeric parameter"},
    {"reset", "10 A=A+1\n20 C=C+1\n30 ? A;\n40 if timerA<50 then delay 60\n50 reset\n", "1",
     "running"},
    {"everything starts at zero", "10 ? A,Y,timerB\n", "0 0 0\n", "end"},
};

class Programs : public ::testing::TestWithParam<Case> {};

TEST_P(Programs, PrintAndEnd) {
  const auto& test = GetParam();
  if (std::string_view(test.name) == "reset")
    return; // never ends: see Machine.ResetStartsAfresh
  for (const auto dispatch : {Dispatch::Threaded, Dispatch::Switch}) {
    const auto run = run_basic(test.text, 10s, -1, dispatch);
    EXPECT_EQ(run.printed, test.printed) << bytecode::listing(compiler::load(test.text));
    EXPECT_EQ(run.end, test.end);
    // The program must not notice interruptions of the machine.
    NotebookHost host;
    Machine machine(3000, 1, dispatch);
    auto chunk = compiler::load(test.text);
    const int line = chunk.lines.front().number;
    machine.start(std::move(chunk), line, Instant{});
    for (Instant limit{}; machine.running() && limit < Instant{10s}; limit += 333333ns)
      while (machine.running() && machine.next_event() < limit)
        machine.run(limit, host);
    EXPECT_EQ(host.printed, run.printed);
    EXPECT_EQ(machine.lines(), run.lines);
  }
}

INSTANTIATE_TEST_SUITE_P(Machine, Programs, ::testing::ValuesIn(cases), [](const auto& program) {
  std::string name = program.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)))
      c = '_';
  return name;
});

TEST(Machine, PerformsAStatementWithoutArgumentsWhereNothingIsComputed) {
  EXPECT_EQ(run_basic("10 mackill\n").notes, std::vector<std::string>{"mackill"});
}

} // namespace
} // namespace orb::vm
