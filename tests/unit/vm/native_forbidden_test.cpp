// Systems that forbid making written memory executable: Linux from 6.3 on for a process that asks,
// and systemd's MemoryDenyWriteExecute, which filters system calls.

#include "vm/machine/native/native.h"

#include "basic_run.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

namespace orb::vm {
namespace {

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

/// Runs a program under that restriction, in a process that then ends.
[[noreturn]] void run_where_forbidden(bool (*forbid)()) {
  if (!forbid()) {
    std::fputs("this kernel cannot forbid it", stderr);
    std::_Exit(0);
  }
  NotebookHost host;
  Machine machine(1'000'000'000, 1, Dispatch::Threaded, Native::On);
  machine.start(compiler::load("10 A=A+1\n20 if A<20000 then goto 10\n30 print A\n"), 10,
                Instant{});
  while (machine.running())
    machine.run(Instant{} + 1ms, host);
  std::fputs(std::string(machine.only_interpreted()).c_str(), stderr);
  std::_Exit(machine.machine_code() == nullptr && host.printed == "20000\n" ? 0 : 1);
}

constexpr const char* forbidden_or_skipped =
    "^(this system does not allow executable memory|this kernel cannot forbid it)$";

TEST(NativeCode, IsDoneWithoutWhereTheKernelForbidsIt) {
  if (!has_native_code())
    GTEST_SKIP() << "no back end in this build";
  EXPECT_EXIT(run_where_forbidden(forbid_by_kernel), ::testing::ExitedWithCode(0),
              forbidden_or_skipped);
}

TEST(NativeCode, IsDoneWithoutWhereAFilterForbidsIt) {
  if (!has_native_code())
    GTEST_SKIP() << "no back end in this build";
  EXPECT_EXIT(run_where_forbidden(forbid_by_filter), ::testing::ExitedWithCode(0),
              forbidden_or_skipped);
}

} // namespace
} // namespace orb::vm
