#pragma once

#include "uploader/gatt.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace orb::uploader {

/// Finds the robot, connects and opens it to commands; where a later try can help, it connects
/// Budgets::opens times. The transport writes packets in pieces; a packet of which a piece is not
/// acknowledged counts as lost. A robot whose name says that orb does not drive it is not
/// connected.
tl::expected<std::unique_ptr<protocol::Transport>, BleError>
open_ble(std::unique_ptr<Gatt> gatt, const Budgets& budgets, const Stop& stop,
         const OnBleStep& on_step, const OnBlePeer& on_peer = {});

/// Why a robot of that name is not connected: it is one that orb does not drive; else nothing.
std::optional<std::string> undriven(std::string_view name);

/// A failure in the words of a link that cannot be opened.
protocol::LinkError describe_open_error(const Endpoint& endpoint, const BleError& error);

/// The budgets of a link that takes packets in pieces and waits for a receipt of each.
Budgets ble_budgets(Budgets budgets);

} // namespace orb::uploader
