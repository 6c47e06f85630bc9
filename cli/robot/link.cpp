#include "cli/robot/link.h"

#include "base/duration.h"
#include "cli/context/config.h"
#include "cli/input/inputs.h"
#include "cli/model/command.h"
#include "cli/terminal/interrupt.h"
#include "compiler/load.h"
#include "disk/disk.h"
#include "spec/packet_v2.h"
#include "uploader/ble.h"
#include "uploader/device_words.h"
#include "uploader/endpoint.h"
#include "vm/ball_transport.h"
#include "vm/common/bluetooth.h"

#include <fmt/format.h>
#include <random>
#include <utility>

namespace orb::cli {
namespace {

using uploader::Endpoint;
using uploader::Scheme;

/// Fixed for `sim:`, so that runs repeat; random if the other end may remember an earlier session.
constexpr std::uint8_t sim_first_seq = 0;

tl::unexpected<Failure> failure(ExitCode exit, std::string message) {
  return tl::unexpected(Failure{exit, std::move(message)});
}

std::uint8_t draw_first_seq() {
  return static_cast<std::uint8_t>(std::random_device{}());
}

} // namespace

namespace {

std::string is_time(const std::string& text) {
  const auto time = parse_duration(text, 1s);
  return time && *time > Duration{} ? std::string()
                                    : "`" + text + "` is not a time such as 2s or 500ms";
}

void add_waits(const Command& command, PortOptions& options) {
  command.add_option("--timeout", options.answer, "how long to wait for one answer")
      .type_name("TIME")
      .check(is_time)
      .show_default();
  command
      .add_option("--connect-timeout", options.step,
                  "how long each step of connecting over Bluetooth LE may take")
      .type_name("TIME")
      .check(is_time)
      .show_default();
}

} // namespace

void add_port_options(const Command& command, PortOptions& options) {
  command
      .add_option("-p,--port", options.port,
                  fmt::format("where the ball is: {}, replay:// or @ball", uploader::port_kinds))
      .environment("ORB_PORT")
      .type_name("URL")
      .show_default();
  add_link_options(command, options);
}

void add_link_options(const Command& command, PortOptions& options) {
  command.add_option("--record", options.record, "record all traffic on the link in this file")
      .type_name("FILE");
  add_waits(command, options);
}

void add_robot_port_options(const Command& command, PortOptions& options, std::string& robot) {
  options.port.clear();
  command
      .add_option("-p,--port", options.port,
                  fmt::format("the robot that the program drives from this computer: {} or @ball",
                              uploader::port_kinds))
      .type_name("URL");
  add_robot_options(command, options, robot);
}

void add_robot_options(const Command& command, PortOptions& options, std::string& robot) {
  command
      .add_option("--robot", robot,
                  "which robot it is; the virtual one drives like it, and the name of a real one "
                  "tells which")
      .check(one_of(names_of(spec::robots)));
  command
      .add_option("--stale", options.stale,
                  "stop a driven robot after this long without sensor data")
      .type_name("TIME")
      .check(is_time)
      .show_default();
  command
      .add_option("--collision-threshold", options.collision_threshold,
                  "how hard a robot has to collide to report it; 1 is the softest")
      .check(whole_number(1, UINT8_MAX))
      .show_default();
  add_waits(command, options);
}

WireLog::~WireLog() {
  if (recording_ && !recording_->empty())
    static_cast<void>(recording_->keep_beside());
}

void WireLog::on_bytes(protocol::Direction direction, ByteView bytes, Instant) {
  const auto line = protocol::recording_line(direction, bytes);
  if (recording_)
    recording_->append(as_bytes(line));
  if (verbosity_ >= 2)
    print_err(line);
}

ExitCode Link::finish(const Context& context, ExitCode exit) {
  if (log == nullptr || !log->recording())
    return exit;
  auto recording = std::exchange(log->recording(), std::nullopt);
  tl::expected<void, IoError> written;
  if (exit == ExitCode::Done) {
    written = recording->publish();
  } else if (!recording->empty()) {
    const auto kept = recording->keep_beside();
    if (!kept)
      written = tl::unexpected(kept.error());
    else if (*kept)
      print_note(
          context,
          fmt::format("this attempt is recorded in {}; the earlier recording is kept", **kept));
  }
  if (written)
    return exit;
  print_error(context, written.error().message);
  if (exit != ExitCode::Done)
    return exit;
  return InterruptGuard::asked() > 0 ? ExitCode::Interrupted : ExitCode::File;
}

tl::expected<Endpoint, Failure> find_endpoint(const Config& config, const std::string& port) {
  const auto url = resolve_port(config, port);
  if (!url)
    return failure(ExitCode::Usage, url.error().message);
  const auto endpoint = uploader::parse_endpoint(*url);
  if (!endpoint)
    return failure(ExitCode::Usage, endpoint.error());
  return *endpoint;
}

std::optional<spec::Robot> named_robot(const Config& config, const std::string& port) {
  if (port.starts_with("@"))
    if (const auto ball = config.balls.find(port.substr(1));
        ball != config.balls.end() && !ball->second.robot.empty())
      return spec::find_robot(ball->second.robot)->robot;
  const auto endpoint = find_endpoint(config, port);
  if (!endpoint || endpoint->scheme != Scheme::Ble || endpoint->name.empty())
    return std::nullopt;
  return spec::robot_called(endpoint->name);
}

namespace {

uploader::Budgets budgets_for(const Endpoint& endpoint, const PortOptions& options) {
  uploader::Budgets budgets;
  budgets.answer = parse_duration(options.answer, 1s).value_or(budgets.answer);
  if (endpoint.scheme != Scheme::Ble)
    return budgets;
  budgets.scan = budgets.ble_connect = budgets.services =
      parse_duration(options.step, 1s).value_or(budgets.scan);
  return uploader::ble_budgets(budgets);
}

/// Bluetooth delivers each packet once; other links, such as a relay, may not.
bool may_double(const Endpoint& endpoint) {
  switch (endpoint.scheme) {
  case Scheme::Serial: return !std::string_view(endpoint.path).starts_with("/dev/rfcomm");
  case Scheme::Tcp:
  case Scheme::Pty: return true;
  case Scheme::Rfcomm:
  case Scheme::Ble:
  case Scheme::Replay:
  case Scheme::Sim: return false;
  }
  return false;
}

} // namespace

tl::expected<uploader::Budgets, Failure> port_budgets(const Context& context,
                                                      const PortOptions& options) {
  const auto endpoint = find_endpoint(context.config, options.port);
  if (!endpoint)
    return tl::unexpected(endpoint.error());
  return budgets_for(*endpoint, options);
}

namespace {

void open_sim(Link& link, spec::Robot robot, const spec::Driving& driving) {
  vm::BallOptions ball;
  ball.robot = robot;
  ball.driving = driving;
  ball.loader = compiler::load;
  link.first_seq = sim_first_seq;
  link.ball = std::make_unique<vm::Ball>(ball);
  if (spec::info(robot).packets == spec::Packets::V1) {
    link.packets = spec::Packets::V1;
    link.transport = std::make_unique<vm::BallTransport>(*link.ball);
    return;
  }
  link.packets = spec::Packets::V2;
  link.robot = std::make_unique<vm::RobotV2>(*link.ball, robot, vm::bluetooth_address(ball.seed));
  link.transport = std::make_unique<vm::BallTransport>(*link.ball, *link.robot);
}

/// The kind of packets sent; nothing if they are mixed.
std::optional<spec::Packets> recorded_packets(const std::vector<protocol::RecordedPiece>& pieces) {
  bool classic = false;
  bool newer = false;
  for (const auto& piece : pieces)
    if (piece.direction == protocol::Direction::ToBall && !piece.bytes.empty())
      (piece.bytes.front() == spec::v2_start ? newer : classic) = true;
  if (classic && newer)
    return std::nullopt;
  return newer ? spec::Packets::V2 : spec::Packets::V1;
}

/// Opens a recording for playback; the session has to start with the recorded sequence number.
tl::expected<void, Failure> open_replay(Link& link, const std::string& path) {
  const auto text = disk::read(path);
  if (!text)
    return failure(ExitCode::NoBall, text.error().message);
  auto pieces = protocol::parse_recording(*text);
  if (!pieces)
    return failure(ExitCode::NoBall, fmt::format("{}: {}", path, pieces.error()));
  link.first_seq = protocol::first_recorded_seq(*pieces).value_or(0);
  link.packets = recorded_packets(*pieces);
  link.transport = std::make_unique<protocol::ReplayTransport>(std::move(*pieces));
  return {};
}

ExitCode exit_code_of(protocol::LinkError::Kind kind) {
  return kind == protocol::LinkError::Kind::Interrupted ? ExitCode::Interrupted
         : kind == protocol::LinkError::Kind::Unfit     ? ExitCode::Refused
                                                        : ExitCode::NoBall;
}

tl::expected<void, Failure> open_real(Link& link, const Endpoint& endpoint,
                                      const uploader::OnBleStep& on_step) {
  const auto meet = [&link](const uploader::BlePeer& peer) {
    link.packets = peer.protocol == spec::BleProtocol::V2 ? spec::Packets::V2 : spec::Packets::V1;
    const auto called = spec::robot_called(peer.name);
    if (!link.named && called && spec::info(*called).packets == link.packets)
      link.named = called;
  };
  auto opened = uploader::open(endpoint, link.budgets, InterruptGuard::asked, on_step, meet);
  if (!opened)
    return failure(exit_code_of(opened.error().kind), opened.error().message);
  link.first_seq = draw_first_seq();
  link.transport = std::move(*opened);
  return {};
}

} // namespace

tl::expected<Link, Failure> open_link(const Context& context, const PortOptions& options,
                                      const uploader::OnBleStep& on_step) {
  const auto endpoint = find_endpoint(context.config, options.port);
  if (!endpoint)
    return tl::unexpected(endpoint.error());
  if (const auto why = uploader::undriven(endpoint->name))
    return failure(ExitCode::Refused, fmt::format("cannot open {}: {}; `orb ports` lists robots",
                                                  endpoint->text, *why));
  // Create the recording first: no commands without it.
  std::optional<disk::Draft> recording;
  if (!options.record.empty()) {
    auto draft = disk::Draft::of(options.record);
    if (!draft)
      return failure(ExitCode::File, draft.error().message);
    recording = *std::move(draft);
  }
  Link link;
  link.name = endpoint->text;
  link.is_sim = endpoint->scheme == Scheme::Sim;
  link.is_ble = endpoint->scheme == Scheme::Ble;
  link.may_double = may_double(*endpoint);
  link.is_uart = endpoint->scheme == Scheme::Serial && link.may_double;
  if (!link.may_double)
    link.packets = spec::Packets::V1; // classic Bluetooth; the other kinds correct this below
  link.named = named_robot(context.config, options.port);
  link.budgets = budgets_for(*endpoint, options);
  tl::expected<void, Failure> opened;
  if (link.is_sim)
    open_sim(link, options.robot, options.driving.value_or(spec::driving(options.robot)));
  else if (endpoint->scheme == Scheme::Replay)
    opened = open_replay(link, endpoint->path);
  else
    opened = open_real(link, *endpoint, on_step);
  if (!opened)
    return tl::unexpected(opened.error());
  if (recording || context.verbosity >= 2) {
    link.log = std::make_unique<WireLog>(context.verbosity, std::move(recording));
    link.transport =
        std::make_unique<protocol::RecordingTransport>(std::move(link.transport), *link.log);
  }
  auto stopper = std::make_unique<InterruptibleTransport>(std::move(link.transport));
  link.stopper = stopper.get();
  link.transport = std::move(stopper);
  return link;
}

} // namespace orb::cli
