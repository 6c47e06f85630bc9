#include "vm/native/native.h"

#include "basic_run.h"
#include "tests/hostile_programs.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <numeric>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace orb::vm {
namespace {

constexpr std::string_view counts = "10 A=A+1\n20 if A<20000 then goto 10\n30 print A\n";

/// What is asked of machine code; skipped where this build has none.
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

/// A program so large that no area of a ball holds it is interpreted.
TEST_F(NativeCodeTest, IsNotMadeOfProgramsThatAreTooLarge) {
  std::string text;
  for (int line = 0; line < 65'000; ++line)
    text += fmt::format("{} A=A*B-C\n", line);
  const auto code = NativeCode::compile(compiler::load(text));
  ASSERT_FALSE(code);
  EXPECT_EQ(code.error(), "the program is too large for machine code");
}

// Systems that let no written memory become executable: Linux from 6.3 on for a process that asks,
// and systemd's MemoryDenyWriteExecute, which filters system calls.

bool forbid_by_kernel() {
  constexpr int set_mdwe = 65;
  return prctl(set_mdwe, 1, 0, 0, 0) == 0;
}

bool forbid_by_filter() {
  constexpr auto protection = offsetof(seccomp_data, args[2]);
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_mprotect, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, protection),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog filter{std::size(program), program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// Runs a program where that is forbidden, in a process that then ends.
[[noreturn]] void run_where_forbidden(bool (*forbid)()) {
  if (!forbid()) {
    std::fputs("this kernel cannot forbid it", stderr);
    std::_Exit(0);
  }
  NotebookHost host;
  Machine machine(1'000'000'000, 1, Dispatch::Threaded, Native::On);
  machine.start(compiler::load(counts), 10, Instant{});
  while (machine.running())
    machine.run(Instant{} + 1ms, host);
  std::fputs(std::string(machine.only_interpreted()).c_str(), stderr);
  std::_Exit(machine.machine_code() == nullptr && host.printed == "20000\n" ? 0 : 1);
}

constexpr const char* forbidden_or_skipped =
    "^(this system does not let memory become executable|this kernel cannot forbid it)$";

TEST_F(NativeCodeTest, IsDoneWithoutWhereTheKernelForbidsIt) {
  EXPECT_EXIT(run_where_forbidden(forbid_by_kernel), ::testing::ExitedWithCode(0),
              forbidden_or_skipped);
}

TEST_F(NativeCodeTest, IsDoneWithoutWhereAFilterForbidsIt) {
  EXPECT_EXIT(run_where_forbidden(forbid_by_filter), ::testing::ExitedWithCode(0),
              forbidden_or_skipped);
}

} // namespace
} // namespace orb::vm
