#pragma once

#include "run/held_robot.h"
#include "structured/text/files.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::editor {

namespace dap {
struct Session;
}

/// A debug adapter without a transport: messages of the Debug Adapter Protocol in, messages out. It
/// reads no clock and no file itself. It answers every message, however malformed, without
/// throwing.
class DebugAdapter {
public:
  /// Connects the robot at a port such as `ble://SB-1A2B`; `kind` names the model, empty if the
  /// port's name tells.
  using OpenRobot = std::function<tl::expected<std::shared_ptr<run::HeldRobot>, Failure>(
      const std::string& port, const std::string& kind)>;

  /// Reads programs from `files`, which must outlive the adapter; relative paths start at `folder`.
  /// Without `open_robot`, programs run on the virtual ball only.
  DebugAdapter(structured::Files& files, std::string folder, OpenRobot open_robot = {});
  ~DebugAdapter();
  DebugAdapter(const DebugAdapter&) = delete;
  DebugAdapter& operator=(const DebugAdapter&) = delete;

  /// Handles one message; returns the answer and the resulting events.
  std::vector<std::string> receive(std::string_view message);

  /// Returns the answer to input that is not a message.
  std::vector<std::string> receive_garbage(std::string_view what);

  /// True if a program has to continue: call work().
  bool busy() const;
  /// Runs the program until it stops, there is something to send, or `interrupted` reports a
  /// message from the client.
  std::vector<std::string> work(const std::function<bool()>& interrupted);

  /// True once the client has ended the session.
  bool ended() const;
  /// True if a bug in orb has ended the session: the client is informed, and the robot told to
  /// stop.
  bool broken() const;

private:
  std::unique_ptr<dap::Session> session_;
};

} // namespace orb::editor
