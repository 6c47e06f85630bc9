#include "vm/machine/native/native.h"

#include "basic_run.h"
#include "tests/hostile_programs.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <numeric>

namespace orb::vm {
namespace {

constexpr std::string_view counts = "10 A=A+1\n20 if A<20000 then goto 10\n30 print A\n";

/// Tests of machine code; skipped if this build has none.
class NativeCodeTest : public ::testing::Test {
protected:
  void SetUp() override {
    if (!has_native_code())
      GTEST_SKIP() << "no back end in this build";
  }
};

TEST_F(NativeCodeTest, IsMadeWhenAProgramHasRunLong) {
  NotebookHost host;
  Machine machine(1'000'000'000, 1);
  machine.start(compiler::load(counts), 10, Instant{});
  const auto due = 200 * static_cast<std::int64_t>(machine.core().code.size());
  machine.run(Instant{} + Duration{due}, host); // a line takes a nanosecond; the last ends too late
  EXPECT_EQ(machine.machine_code(), nullptr);
  machine.run(Instant{} + Duration{due + 2}, host);
  EXPECT_NE(machine.machine_code(), nullptr);
  machine.start(compiler::load(counts), 10, machine.now());
  EXPECT_EQ(machine.machine_code(), nullptr);
}

TEST_F(NativeCodeTest, IsSharedByIdenticalPrograms) {
  NativePrograms programs;
  NotebookHost host;
  Machine first(1'000'000'000, 1, Dispatch::Threaded, Native::On, &programs);
  Machine second(1'000'000'000, 2, Dispatch::Threaded, Native::On, &programs);
  Machine other(1'000'000'000, 3, Dispatch::Threaded, Native::On, &programs);
  first.start(compiler::load(counts), 10, Instant{});
  second.start(compiler::load(counts), 10, Instant{});
  other.start(compiler::load("10 A=A+2\n20 goto 10\n"), 10, Instant{});
  for (auto* machine : {&first, &second, &other})
    machine->run(Instant{} + 1us, host);
  ASSERT_NE(first.machine_code(), nullptr);
  EXPECT_EQ(first.machine_code(), second.machine_code());
  EXPECT_NE(first.machine_code(), other.machine_code());
}

TEST_F(NativeCodeTest, GoesBackWhereItDoesNotPay) {
  NotebookHost host;
  Machine machine(1'000'000'000, 1);
  machine.start(compiler::load("10 A=A+1\n20 B=speed\n30 goto 10\n"), 10, Instant{});
  machine.run(Instant{} + 5us, host);
  EXPECT_NE(machine.machine_code(), nullptr);
  machine.run(Instant{} + 100us, host);
  EXPECT_EQ(machine.machine_code(), nullptr);
  EXPECT_EQ(machine.variable(0), 33333);
}

TEST_F(NativeCodeTest, IsListedForEveryLine) {
  const auto chunk = compiler::load("10 A=B*7\n20 print A\n30 goto 10\n");
  const auto listing = native_listing(chunk);
  ASSERT_EQ(listing.lines.size(), 3u);
  EXPECT_NE(listing.lines[0].find("imul"), std::string::npos) << listing.lines[0];
  EXPECT_NE(listing.lines[2].find("jmp"), std::string::npos) << listing.lines[2];
  EXPECT_NE(listing.entry.find("push"), std::string::npos) << listing.entry;
  EXPECT_NE(listing.exits.find("ret"), std::string::npos) << listing.exits;
}

TEST_F(NativeCodeTest, TellsProfilersWhereEveryLineIs) {
  const auto chunk = compiler::load("10 A=B*3\n20 print A\n30 goto 10\n");
  const auto code = NativeCode::compile(chunk);
  ASSERT_TRUE(code) << code.error();
  const auto& pieces = (*code)->pieces();
  std::vector<int> lines;
  const auto* address = static_cast<const std::byte*>(pieces.front().address);
  for (const auto& piece : pieces) {
    EXPECT_EQ(piece.address, address) << piece.line;
    address += piece.size;
    lines.push_back(piece.line);
  }
  EXPECT_EQ(lines, (std::vector{0, 10, 20, 30, 0}));
}

TEST_F(NativeCodeTest, TakesBoundedMemoryForHostilePrograms) {
  constexpr std::size_t size = 4096;
  for (const auto& program : testing::hostile_programs(size)) {
    SCOPED_TRACE(program.what);
    ASSERT_GT(program.text.size(), size - 64);
    const auto chunk = compiler::load(program.text);
    ASSERT_EQ(bytecode::verify(chunk), std::nullopt);
    const auto code = NativeCode::compile(chunk);
    ASSERT_TRUE(code) << code.error();
    const auto& pieces = (*code)->pieces();
    const auto bytes =
        std::accumulate(pieces.begin(), pieces.end(), std::size_t{0},
                        [](std::size_t sum, const auto& piece) { return sum + piece.size; });
    EXPECT_LT(bytes, 24 * size);
  }
}

/// A program larger than any area of a ball is interpreted.
TEST_F(NativeCodeTest, IsNotMadeOfProgramsThatAreTooLarge) {
  std::string text;
  for (int line = 0; line < 65'000; ++line)
    text += fmt::format("{} A=A*B-C\n", line);
  const auto code = NativeCode::compile(compiler::load(text));
  ASSERT_FALSE(code);
  EXPECT_EQ(code.error(), "the program is too large for machine code");
}

} // namespace
} // namespace orb::vm
