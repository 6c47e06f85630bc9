#include "cli/terminal/watch.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>

namespace orb::cli {
namespace {

/// How often the files are looked at. Looking works on every file system and through every way in
/// which an editor saves; a notification does not.
constexpr timespec period{0, 100'000'000};

/// What changes when a file is written, replaced or removed.
using Stamp = std::tuple<bool, ino_t, off_t, time_t, long>;

Stamp stamp(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return {};
  return {true, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

std::vector<Stamp> stamps(const std::vector<std::string>& files) {
  std::vector<Stamp> list;
  for (const auto& file : files)
    list.push_back(stamp(file));
  return list;
}

/// The signals that end watching, held back so that none is lost between two looks; in the watching
/// process for good, so that a second one does not end it before its exit code.
class Held {
public:
  Held() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM})
      sigaddset(&signals_, signal);
    sigprocmask(SIG_BLOCK, &signals_, &before_);
  }

  /// For the process of a run, which they end.
  void release() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  /// Waits one period; true when a signal came.
  bool came() const { return sigtimedwait(&signals_, nullptr, &period) > 0; }

private:
  sigset_t signals_;
  sigset_t before_;
};

/// One run of the command in a process of its own.
class Run {
public:
  Run(Context& context, Held& held, const std::function<void()>& once) {
    std::fflush(nullptr);
    process_ = ::fork();
    if (process_ < 0)
      print_error(context, fmt::format("cannot start a run: {}; the next change tries again",
                                       std::strerror(errno)));
    if (process_ != 0)
      return;
    held.release();
    once();
    std::fflush(nullptr);
    ::_exit(static_cast<int>(context.exit));
  }
  ~Run() {
    if (process_ <= 0)
      return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Takes note of an end since the last call: its status, as waitpid(2) gives it.
  std::optional<int> ended() {
    int status = 0;
    if (process_ <= 0 || ::waitpid(process_, &status, WNOHANG) == 0)
      return std::nullopt;
    process_ = 0;
    return status;
  }

private:
  pid_t process_ = 0;
};

} // namespace

void watch(Context& context, const std::function<std::vector<std::string>()>& list,
           const std::function<void()>& once, const std::function<void()>& ended,
           const std::vector<std::string>&) {
  context.exit = ExitCode::Done;
  Held held;
  auto files = list();
  auto seen = stamps(files);
  std::optional<Run> run;
  run.emplace(context, held, once);
  while (!held.came()) {
    if (const auto status = run->ended()) {
      if (WIFSIGNALED(*status) && WTERMSIG(*status) == SIGPIPE)
        return; // nobody reads any more
      ended();
      print_note(context, "waiting for a change; Ctrl-C ends");
    }
    const auto now = stamps(files);
    if (now == seen)
      continue;
    const auto changed = std::mismatch(now.begin(), now.end(), seen.begin()).first - now.begin();
    print_note(context, fmt::format("--- {} changed", files[static_cast<std::size_t>(changed)]));
    files = list();
    seen = stamps(files);
    run.reset();
    run.emplace(context, held, once);
  }
}

} // namespace orb::cli
