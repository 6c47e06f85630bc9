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
  spec::Robot robot = spec::Robot::Sphero; ///< that `sim:` is
  std::optional<spec::Driving> driving;    ///< how that drives; else like `robot`
  std::string record;          ///< a file for the bytes of both directions; empty for none
  std::string answer = "2s";   ///< the wait for one answer
  std::string step = "10s";    ///< the wait for one step to a robot over Bluetooth LE
  std::string stale = "500ms"; ///< without sensor data for so long a driven robot is stopped
  int collision_threshold = run::CollisionLimits{}.threshold; ///< of a driven robot
};

/// Adds `--port`, which says where a robot is that serves as a program's body, `--robot`,
/// `--timeout` and `--connect-timeout`. Without `--port` there is none, whatever the environment
/// says. `robot` becomes the name of a row of spec/robots.def; empty where none is given.
void add_robot_port_options(const Command& command, PortOptions& options, std::string& robot);

/// All of these but `--port`.
void add_robot_options(const Command& command, PortOptions& options, std::string& robot);

/// Adds `--port`, which the environment may give as ORB_PORT, `--record`, `--timeout` and
/// `--connect-timeout`.
void add_port_options(const Command& command, PortOptions& options);

/// All of these but `--port`.
void add_link_options(const Command& command, PortOptions& options);

/// Hears the wire for a recording and for `-vv`.
class WireLog final : public protocol::WireListener {
public:
  WireLog(int verbosity, std::optional<disk::Draft> recording)
      : verbosity_(verbosity), recording_(std::move(recording)) {}
  WireLog(const WireLog&) = delete;
  WireLog& operator=(const WireLog&) = delete;
  /// A recording that nobody has taken, because the command ended in the middle, is kept.
  ~WireLog() override;
  void on_bytes(protocol::Direction direction, ByteView bytes, Instant now) override;
  /// Nothing where nothing is recorded.
  std::optional<disk::Draft>& recording() { return recording_; }

private:
  int verbosity_;
  std::optional<disk::Draft> recording_;
};

/// An open link to a ball and a session on it.
struct Link {
  bool is_sim = false;
  bool is_ble = false;
  bool is_uart = false;    ///< a serial port that is no Bluetooth
  bool may_double = false; ///< nothing says that it delivers each packet once
  std::string name;        ///< the port, for messages
  uploader::Budgets budgets;
  std::uint8_t first_seq = 0;
  std::unique_ptr<WireLog> log;
  std::unique_ptr<vm::Ball> ball;       ///< of `sim:`
  std::unique_ptr<vm::RobotV2> robot;   ///< the same, where it speaks packets v2
  std::optional<spec::Robot> named;     ///< the robot that its name tells
  std::optional<spec::Packets> packets; ///< that the link tells: one that is classic Bluetooth, say
  std::unique_ptr<protocol::Transport> transport;
  InterruptibleTransport* stopper = nullptr; ///< the outermost layer of `transport`

  /// Puts the recording into its place, if there is one; after a failure beside an older one. The
  /// code to end with: `exit`, where that is a failure already, whatever becomes of the recording.
  ExitCode finish(const Context& context, ExitCode exit);
};

/// The waits of the port that the options name, or why they name none; nothing is opened.
tl::expected<uploader::Budgets, Failure> port_budgets(const Context& context,
                                                      const PortOptions& options);

/// What a URL, a bare path or `@ball` stands for; Usage where it stands for nothing.
tl::expected<uploader::Endpoint, Failure> find_endpoint(const Config& config,
                                                        const std::string& port);

/// The robot that the settings of `@ball` tell, or the name in a URL, as `ble://SB-1A2B` does;
/// nothing where neither does.
std::optional<spec::Robot> named_robot(const Config& config, const std::string& port);

/// Opens the link that the options name: a URL, a bare path or `@ball`. `on_step` hears of the
/// steps of Bluetooth LE.
tl::expected<Link, Failure> open_link(const Context& context, const PortOptions& options,
                                      const uploader::OnBleStep& on_step = {});

} // namespace orb::cli
