#pragma once

#include "uploader/gatt.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace orb::uploader {

/// Finds the robot, connects and opens it to commands; makes up to Budgets::opens attempts to
/// connect if another one can help. The transport writes packets in pieces; a packet counts as lost
/// if one of its pieces is not acknowledged. Refuses to connect to a robot whose name says that orb
/// does not drive it.
tl::expected<std::unique_ptr<protocol::Transport>, BleError>
open_ble(std::unique_ptr<Gatt> gatt, const Budgets& budgets, const StopRequests& stop,
         const OnBleStep& on_step, const OnBlePeer& on_peer = {});

/// Returns why orb does not connect to a robot of that name; nullopt if it does.
std::optional<std::string> undriven(std::string_view name);

/// Describes a failure as a link that cannot be opened.
protocol::LinkError describe_open_error(const Endpoint& endpoint, const BleError& error);

/// Returns the budgets for a link that takes packets in pieces and acknowledges each.
Budgets ble_budgets(Budgets budgets);

} // namespace orb::uploader
