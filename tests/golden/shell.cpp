#include "tests/golden/shell.h"

#include <cerrno>
#include <csignal>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shell {
namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t running = 0; ///< the process group of the command; 0 if there is none
std::vector<pid_t> groups;

void pass_on(int signal) {
  interrupted = 1;
  if (running != 0)
    ::kill(-running, signal);
}

constexpr int passed_on[] = {SIGINT, SIGTERM, SIGHUP};

} // namespace

void watch_signals() {
  struct sigaction action = {};
  action.sa_handler = pass_on;
  for (const int signal : passed_on)
    ::sigaction(signal, &action, nullptr);
}

bool was_interrupted() {
  return interrupted != 0;
}

int run(const std::string& line) {
  const pid_t child = ::fork();
  if (child < 0)
    return -1;
  if (child == 0) {
    ::setpgid(0, 0);
    for (const int signal : passed_on)
      ::signal(signal, SIG_DFL);
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  ::setpgid(child, child); // both processes do it, because either may come first
  groups.push_back(child);
  running = child;
  if (was_interrupted()) // since the last call
    ::kill(-child, SIGTERM);
  int status = -1;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  running = 0;
  return status;
}

void end_all() {
  for (const pid_t group : groups)
    ::kill(-group, SIGTERM);
  groups.clear();
}

} // namespace shell
