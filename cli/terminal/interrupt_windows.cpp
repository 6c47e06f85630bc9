#include "cli/terminal/interrupt.h"

#include <atomic>
#include <windows.h>

namespace orb::cli {
namespace {

std::atomic<int> requests = 0; ///< how often the user asked to stop
std::atomic<int> guards = 0;   ///< number of live guards

/// Windows calls it on a separate thread: for Ctrl-C, Ctrl-Break, and closing the console, which
/// ends the process when this returns or after a few seconds.
BOOL WINAPI count_request(DWORD event) {
  requests.fetch_add(1, std::memory_order_relaxed);
  if (event == CTRL_CLOSE_EVENT || event == CTRL_SHUTDOWN_EVENT || event == CTRL_LOGOFF_EVENT)
    while (guards > 0) // meanwhile the robot is stopped
      ::Sleep(10);
  return TRUE;
}

} // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0)
    return;
  requests = 0;
  ::SetConsoleCtrlHandler(count_request, TRUE);
}

InterruptGuard::~InterruptGuard() {
  if (--guards == 0)
    ::SetConsoleCtrlHandler(count_request, FALSE);
}

int InterruptGuard::asked() {
  return requests;
}

} // namespace orb::cli
