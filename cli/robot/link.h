#pragma once

#include "cli/context/context.h"
#include "cli/terminal/interrupt.h"
#include "disk/disk.h"
#include "protocol/recording.h"
#include "run/tether/wire.h"
#include "uploader/ble_error.h"
#include "uploader/budgets.h"
#include "uploader/endpoint.h"
#include "uploader/upload.h"
#include "vm/ball.h"
#include "vm/robot_v2.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

/// The options of every command that talks to a ball.
struct PortOptions {
  std::string port = "sim:";
  spec::Robot robot = spec::Robot::Sphero; ///< model that `sim:` simulates
  std::optional<spec::Driving> driving;    ///< how it drives; otherwise like `robot`
  std::string record;          ///< file for the bytes of both directions; empty for none
  std::string answer = "2s";   ///< timeout for one answer
  std::string step = "10s";    ///< timeout for one connection step over Bluetooth LE
  std::string stale = "500ms"; ///< stops a driven robot after this long without sensor data
  int collision_threshold = run::CollisionLimits{}.threshold; ///< for a driven robot
};

/// Adds `--port` for a robot that serves as a program's body, `--robot`, `--timeout` and
/// `--connect-timeout`. Only `--port` names a robot, the environment does not. `robot` is set to
/// the name of a row of spec/robots.def; empty if not given.
void add_robot_port_options(const Command& command, PortOptions& options, std::string& robot);

/// The same without `--port`.
void add_robot_options(const Command& command, PortOptions& options, std::string& robot);

/// Adds `--port`, which also comes from ORB_PORT, `--record`, `--timeout` and `--connect-timeout`.
void add_port_options(const Command& command, PortOptions& options);

/// The same without `--port`.
void add_link_options(const Command& command, PortOptions& options);

/// Records the wire for `--record` and prints it for `-vv`.
class WireLog final : public protocol::WireListener {
public:
  WireLog(int verbosity, std::optional<disk::Draft> recording)
      : verbosity_(verbosity), recording_(std::move(recording)) {}
  WireLog(const WireLog&) = delete;
  WireLog& operator=(const WireLog&) = delete;
  /// Keeps a recording that was not taken because the command ended early.
  ~WireLog() override;
  void on_bytes(protocol::Direction direction, ByteView bytes, Instant now) override;
  /// Nothing if there is no recording.
  std::optional<disk::Draft>& recording() { return recording_; }

private:
  int verbosity_;
  std::optional<disk::Draft> recording_;
};

/// An open link to a ball and a session on it.
struct Link {
  bool is_sim = false;
  bool is_ble = false;
  bool is_uart = false;    ///< a serial port other than Bluetooth
  bool may_double = false; ///< the link does not guarantee that each packet arrives once
  std::string name;        ///< the port, for messages
  uploader::Budgets budgets;
  std::uint8_t first_seq = 0;
  std::unique_ptr<WireLog> log;
  std::unique_ptr<vm::Ball> ball;       ///< for `sim:`
  std::unique_ptr<vm::RobotV2> robot;   ///< for `sim:` with packets v2
  std::optional<spec::Robot> named;     ///< known from its name
  std::optional<spec::Packets> packets; ///< known from the link, such as classic Bluetooth
  std::unique_ptr<protocol::Transport> transport;
  InterruptibleTransport* stopper = nullptr; ///< the outermost layer of `transport`

  /// Moves the recording to its final name, after a failure next to an older one. Returns the exit
  /// code: `exit` if it is a failure already.
  ExitCode finish(const Context& context, ExitCode exit);
};

/// Reads the timeouts, and checks the port; opens nothing.
tl::expected<uploader::Budgets, Failure> port_budgets(const Context& context,
                                                      const PortOptions& options);

/// Resolves a URL, a bare path or `@ball`; fails with Usage for anything else.
tl::expected<uploader::Endpoint, Failure> find_endpoint(const Config& config,
                                                        const std::string& port);

/// The robot known from the settings of `@ball`, or from the name in a URL such as `ble://SB-1A2B`;
/// nothing if unknown.
std::optional<spec::Robot> named_robot(const Config& config, const std::string& port);

/// Opens the link that the options name: a URL, a bare path or `@ball`. Calls `on_step` for each
/// step of Bluetooth LE.
tl::expected<Link, Failure> open_link(const Context& context, const PortOptions& options,
                                      const uploader::OnBleStep& on_step = {});

} // namespace orb::cli
