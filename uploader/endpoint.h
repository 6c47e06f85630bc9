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
  Ble,    ///< `ble://AA:BB:CC:DD:EE:FF` or `ble://NAME`: open_ble() makes the link
  Tcp,    ///< `tcp://host:port`
  Pty,    ///< `pty:///path`
  Sim,    ///< `sim:`, a ball in this process: whoever holds one makes the link
  Replay  ///< `replay://file`: whoever reads the file makes the link
};

using BluetoothAddress = std::array<std::uint8_t, 6>; ///< in the order in which it is written

/// Where a ball is, as a URL says it.
struct Endpoint {
  Scheme scheme = Scheme::Sim;
  std::string path; ///< Serial, Pty, Replay
  std::string host; ///< Tcp
  std::string name; ///< Ble: what the robot advertises; empty where the address is given
  std::uint16_t port = 0;
  BluetoothAddress address{};
  std::uint8_t channel = 1;
  std::string text; ///< the URL as it was given, for messages
};

/// `AA:BB:CC:DD:EE:FF`, read and written.
std::optional<BluetoothAddress> parse_bluetooth_address(std::string_view text);
std::string to_string(const BluetoothAddress& address);

/// Reads a URL; the error is a sentence that says which forms there are.
tl::expected<Endpoint, std::string> parse_endpoint(std::string_view url);

/// How often waiting was asked to stop, as by Ctrl-C.
using Stop = std::function<int()>;

/// What is said of a link that nobody waits for any more before it is open.
inline constexpr auto interrupted_opening = "interrupted; the ball is unchanged";

/// Opens the link: raw, exclusive and without old bytes. Tries Budgets::opens times where a later
/// try can help. Not for Sim and Replay. The error says what helps; it is Interrupted within
/// stop_notice of `stop`, and so is a write of the link that cannot go on when `stop` is one more.
/// `on_step` hears of the steps of Bluetooth LE, `on_peer` of the robot that they lead to.
tl::expected<std::unique_ptr<protocol::Transport>, protocol::LinkError>
open(const Endpoint& endpoint, const Budgets& budgets, const Stop& stop,
     const OnBleStep& on_step = {}, const OnBlePeer& on_peer = {});

/// The bytes of a `sockaddr_rc` for connect(2): family, the address with its last byte first,
/// channel. Written by hand because the kernel's header comes with the GPL.
std::array<std::uint8_t, 10> rfcomm_socket_address(const BluetoothAddress& address,
                                                   std::uint8_t channel);

/// Why opening `endpoint` failed with an error of the operating system, and what helps.
protocol::LinkError describe_open_error(const Endpoint& endpoint, int error);

} // namespace orb::uploader
