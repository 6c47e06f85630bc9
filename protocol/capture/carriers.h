#pragma once

#include "protocol/capture/connections.h"
#include "protocol/conversation.h"
#include "spec/ble.h"

#include <map>
#include <optional>
#include <vector>

namespace orb::protocol {

/// The attributes of a device by handle: a robot's characteristic, or nullopt for any other.
/// Contains only handles whose discovery was captured.
using Attributes = std::map<std::uint16_t, std::optional<spec::BleCharacteristic>>;

/// Adds what the answers to a discovery in this connection reveal.
void learn_attributes(const Connection& connection, Attributes& known);

/// Returns the writes to a robot's characteristics and its notifications; without lines if there
/// were none. An unknown handle counts as a robot's if its bytes form packets.
Conversation read_gatt(const Connection& connection, const Attributes& known);

/// Returns the RFCOMM data of this connection: a conversation for each channel that contains
/// packets.
std::vector<Conversation> read_rfcomm(const Connection& connection);

} // namespace orb::protocol
