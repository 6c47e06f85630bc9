#include "cli/terminal/watch.h"

#include "cli/terminal/watch_loop.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>

namespace orb::cli {
namespace {

constexpr timespec period{0, 100'000'000};

/// What changes when a file is written, replaced or removed.
using Stamp = std::tuple<bool, ino_t, off_t, time_t, long>;

Stamp stamp(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return {};
  return {true, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Blocks the signals that end watching, so that none is lost between two checks. In the watching
/// process for good: a second signal must not end it before its exit code.
class BlockedSignals {
public:
  BlockedSignals() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM})
      sigaddset(&signals_, signal);
    sigprocmask(SIG_BLOCK, &signals_, &before_);
  }

  /// Unblocks them, for the process of a run, which they end.
  void release() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  /// Waits one period; returns true if a signal came.
  bool came() const { return sigtimedwait(&signals_, nullptr, &period) > 0; }

private:
  sigset_t signals_;
  sigset_t before_;
};

/// Runs the command in a child process, one at a time.
class Runs {
public:
  Runs(Context& context, const std::function<void()>& once) : context_(context), once_(once) {}
  ~Runs() { stop(); }
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  void start() {
    stop();
    std::fflush(nullptr);
    process_ = ::fork();
    if (process_ < 0)
      print_error(context_, fmt::format("cannot start a run: {}; the next change tries again",
                                        std::strerror(errno)));
    if (process_ != 0)
      return;
    signals_.release();
    once_();
    std::fflush(nullptr);
    ::_exit(static_cast<int>(context_.exit));
  }

  RunEnd end() {
    int status = 0;
    if (process_ <= 0 || ::waitpid(process_, &status, WNOHANG) == 0)
      return RunEnd::NotYet;
    process_ = 0;
    const bool pipe = WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE;
    return pipe ? RunEnd::ReaderGone : RunEnd::Finished;
  }

  bool interrupted() { return signals_.came(); }

private:
  void stop() {
    if (process_ <= 0)
      return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

  Context& context_;
  const std::function<void()>& once_;
  BlockedSignals signals_;
  pid_t process_ = 0;
};

} // namespace

void watch(Context& context, const std::function<std::vector<std::string>()>& list,
           const std::function<void()>& once, const std::function<void()>& ended,
           const std::vector<std::string>&) {
  context.exit = ExitCode::Done;
  watch_with(Runs(context, once), stamp, context, list, ended);
}

} // namespace orb::cli
