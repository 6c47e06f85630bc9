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
/// reads no clock and no file by itself, and answers every message, however malformed, without
/// throwing.
class DebugAdapter {
public:
  /// Readies the robot at a port, such as `ble://SB-1A2B`; `kind` says which it is, and is empty
  /// where its name tells.
  using OpenRobot = std::function<tl::expected<std::shared_ptr<run::HeldRobot>, Failure>(
      const std::string& port, const std::string& kind)>;

  /// Programs are read from `files`, which must outlive the adapter; paths that are not absolute
  /// count from `folder`. Without `open_robot` programs run on the virtual ball only.
  DebugAdapter(structured::Files& files, std::string folder, OpenRobot open_robot = {});
  ~DebugAdapter();
  DebugAdapter(const DebugAdapter&) = delete;
  DebugAdapter& operator=(const DebugAdapter&) = delete;

  /// Takes one message; returns the answer and the events that it causes.
  std::vector<std::string> receive(std::string_view message);

  /// What to answer to something that is not a message at all.
  std::vector<std::string> receive_garbage(std::string_view what);

  /// A program is to go on: call work().
  bool busy() const;
  /// Lets the program go on until it stands still, there is something to send, or `interrupted`
  /// says that the client has spoken.
  std::vector<std::string> work(const std::function<bool()>& interrupted);

  /// The client has said that it is done.
  bool ended() const;
  /// A bug of orb has ended the session: the client has been told, and the robot to stop.
  bool broken() const;

private:
  std::unique_ptr<dap::Session> session_;
};

} // namespace orb::editor
