#include "cli/terminal/browser.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace orb::cli {
namespace {

/// How long a command may take to fail. A newly started browser takes longer.
constexpr timespec opening_time{2, 0};

using Words = std::vector<std::string>;

std::vector<Words> openers(const std::string& file) {
  const char* set = std::getenv("BROWSER");
  std::vector<Words> list;
  std::istringstream choices(set != nullptr ? set : "");
  for (std::string choice; std::getline(choices, choice, ':');) {
    std::istringstream parts(choice);
    Words words;
    bool names_file = false;
    for (std::string word; parts >> word;) {
      const auto at = word.find("%s");
      names_file |= at != std::string::npos;
      words.push_back(at == std::string::npos ? word : word.replace(at, 2, file));
    }
    if (words.empty())
      continue;
    if (!names_file)
      words.push_back(file);
    list.push_back(std::move(words));
  }
  list.push_back({"xdg-open", file});
  return list;
}

/// Waits briefly for the process to end; returns its status as from waitpid(2).
std::optional<int> soon_ended(pid_t process, const sigset_t& child_ends) {
  int status = 0;
  if (::waitpid(process, &status, WNOHANG) != 0)
    return status;
  ::sigtimedwait(&child_ends, nullptr, &opening_time);
  return ::waitpid(process, &status, WNOHANG) != 0 ? std::optional(status) : std::nullopt;
}

/// Starts a command without a terminal and without our signals; returns true if it may have worked.
bool start(const Words& words) {
  std::vector<char*> arguments;
  for (const auto& word : words)
    arguments.push_back(const_cast<char*>(word.c_str())); // execvp(3) does not modify its arguments
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, fd, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);

  sigset_t child_ends;
  sigset_t before;
  sigemptyset(&child_ends);
  sigaddset(&child_ends, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child_ends, &before);
  pid_t process = 0;
  const bool started =
      ::posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ) == 0;
  const auto status = started ? soon_ended(process, child_ends) : std::nullopt;
  sigprocmask(SIG_SETMASK, &before, nullptr);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return started && (!status || (WIFEXITED(*status) && WEXITSTATUS(*status) == 0));
}

} // namespace

tl::expected<void, std::string> show_in_browser(const std::string& path) {
  std::error_code ignored;
  const auto file = std::filesystem::absolute(path, ignored).string();
  for (const auto& command : openers(file))
    if (start(command))
      return {};
  return tl::unexpected(fmt::format("no browser could be started: install xdg-utils, or name one "
                                    "in `BROWSER`; the report is in {}",
                                    path));
}

} // namespace orb::cli
