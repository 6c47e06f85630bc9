#include "editor/dap/debug_adapter.h"

#include "base/contain.h"
#include "editor/dap/session.h"

#include <utility>

namespace orb::editor {

namespace {

/// Runs a step. An exception ends the session, after the robot has stopped.
std::vector<std::string> contained(dap::Session& session, const std::function<void()>& step) {
  const auto done = contain([&]() -> tl::expected<void, Failure> {
    step();
    return {};
  });
  if (!done)
    session.break_off(done.error().message);
  return std::exchange(session.out, {});
}

} // namespace

DebugAdapter::DebugAdapter(structured::Files& files, std::string folder, OpenRobot open_robot)
    : session_(std::make_unique<dap::Session>(files, std::move(folder), std::move(open_robot))) {}
DebugAdapter::~DebugAdapter() = default;

std::vector<std::string> DebugAdapter::receive(std::string_view message) {
  return contained(*session_, [&] { session_->receive(message); });
}

std::vector<std::string> DebugAdapter::receive_garbage(std::string_view what) {
  session_->respond({}, dap::refuse(std::string(what)));
  return std::exchange(session_->out, {});
}

bool DebugAdapter::busy() const {
  return session_->going;
}

bool DebugAdapter::ended() const {
  return session_->ended;
}

bool DebugAdapter::broken() const {
  return session_->broken;
}

std::vector<std::string> DebugAdapter::work(const std::function<bool()>& interrupted) {
  constexpr std::size_t enough = 64; // messages to collect before sending them
  return contained(*session_, [&] {
    if (!session_->going)
      return;
    const auto why =
        session_->work([&] { return session_->out.size() >= enough || interrupted(); });
    session_->work = [this](const debug::GiveUp& give_up) {
      return session_->debugger->resume(give_up);
    };
    if (why.reason != debug::StopEvent::Reason::GivenUp)
      session_->take(why);
  });
}

} // namespace orb::editor
