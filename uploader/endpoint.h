#pragma once

#include "protocol/transport.h"
#include "uploader/ble_error.h"
#include "uploader/budgets.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::uploader {

enum class Scheme : std::uint8_t {
  Serial, ///< `serial:///dev/rfcomm0`, or the bare path
  Rfcomm, ///< `rfcomm://AA:BB:CC:DD:EE:FF[/1]`
  Ble,    ///< `ble://AA:BB:CC:DD:EE:FF` or `ble://NAME`: opened by open_ble()
  Tcp,    ///< `tcp://host:port`
  Pty,    ///< `pty:///path`
  Sim,    ///< `sim:`, a ball in this process: its owner makes the link
  Replay  ///< `replay://file`: the reader of the file makes the link
};

using BluetoothAddress = std::array<std::uint8_t, 6>; ///< in written order

/// The address of a ball, parsed from a URL.
struct Endpoint {
  Scheme scheme = Scheme::Sim;
  std::string path; ///< Serial, Pty, Replay
  std::string host; ///< Tcp
  std::string name; ///< Ble: the advertised name; empty if the address is given
  std::uint16_t port = 0;
  BluetoothAddress address{};
  std::uint8_t channel = 1;
  std::string text; ///< the URL as given, for messages
};

/// Parse and write `AA:BB:CC:DD:EE:FF`.
std::optional<BluetoothAddress> parse_bluetooth_address(std::string_view text);
std::string to_string(const BluetoothAddress& address);

/// Parses a URL. The error is a sentence that lists the forms.
tl::expected<Endpoint, std::string> parse_endpoint(std::string_view url);

/// Returns how often a stop was requested, for example by Ctrl-C.
using StopRequests = std::function<int()>;

/// Message for a link whose opening was stopped by the user.
inline constexpr auto interrupted_opening = "interrupted; the ball is unchanged";

/// Opens the link: raw, exclusive and without old bytes. Makes up to Budgets::opens attempts if
/// another one can help. Not for Sim and Replay. The error says what helps. `stop` above 0 ends
/// opening with Interrupted within stop_notice; later a blocked write ends when `stop` has grown.
/// `on_step` receives the steps of Bluetooth LE, `on_peer` the robot found.
tl::expected<std::unique_ptr<protocol::Transport>, protocol::LinkError>
open(const Endpoint& endpoint, const Budgets& budgets, const StopRequests& stop,
     const OnBleStep& on_step = {}, const OnBlePeer& on_peer = {});

/// Returns the bytes of a `sockaddr_rc` for connect(2): family, address with its last byte first,
/// channel. Written by hand because the kernel's header is under the GPL.
std::array<std::uint8_t, 10> rfcomm_socket_address(const BluetoothAddress& address,
                                                   std::uint8_t channel);

/// Describes why opening `endpoint` failed with an errno value, and what helps.
protocol::LinkError describe_open_error(const Endpoint& endpoint, int error);

} // namespace orb::uploader
