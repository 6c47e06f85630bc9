#include "cli/terminal/interrupt.h"

#include <atomic>
#include <csignal>

namespace orb::cli {
namespace {

/// How often the user asked to stop. The signal handler touches nothing else.
std::atomic<int> requests = 0;
static_assert(std::atomic<int>::is_always_lock_free);

/// The number of live guards: with several robots, one for all and one for each.
std::atomic<int> guards = 0;

extern "C" void count_request(int) {
  requests.fetch_add(1, std::memory_order_relaxed);
}

} // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0)
    return;
  requests = 0;
  struct sigaction action {};
  action.sa_handler = count_request;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // Losing the terminal must not lose control of the robot. Under nohup, SIGHUP stays ignored.
  struct sigaction before {};
  ::sigaction(SIGHUP, nullptr, &before);
  hears_hangup_ = before.sa_handler != SIG_IGN;
  if (hears_hangup_)
    ::sigaction(SIGHUP, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
  if (--guards > 0)
    return;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (hears_hangup_)
    std::signal(SIGHUP, SIG_DFL);
}

int InterruptGuard::asked() {
  return requests;
}

} // namespace orb::cli
