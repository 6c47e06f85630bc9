#include "cli/commands/commands.h"
#include "cli/model/command_line.h"
#include "disk/disk.h"
#include "tests/golden/files.h"
#include "vm/machine/native/native.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string_view>
#include <sys/prctl.h>

namespace orb::cli {
namespace {

constexpr std::string_view cannot_forbid = "this kernel cannot forbid it";

/// Runs `orb run -v` in a separate process in which written memory must not become executable, as
/// Linux offers from 6.3 on.
[[noreturn]] void run_where_forbidden(const std::filesystem::path& file) {
  constexpr int set_mdwe = 65;
  if (prctl(set_mdwe, 1, 0, 0, 0) != 0) {
    print_err(cannot_forbid);
    std::_Exit(0);
  }
  Context context;
  all_commands(context)->parse({"run", "-v", "--native=on", file.string()});
  std::_Exit(static_cast<int>(context.exit));
}

TEST(Run, SaysThatTheSystemForbidsMachineCode) {
  if (!vm::has_native_code())
    GTEST_SKIP() << "no back end in this build";
  const files::Scratch folder;
  const auto file = folder.path() / "run_test.bas";
  ASSERT_TRUE(disk::write(file, as_bytes("10 A = 1\n")));
  EXPECT_EXIT(run_where_forbidden(file), ::testing::ExitedWithCode(0),
              "only interpreted: this system does not allow executable memory|" +
                  std::string(cannot_forbid));
}

} // namespace
} // namespace orb::cli
