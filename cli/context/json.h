#pragma once

#include "protocol/describe.h"

#include <nlohmann/json.hpp>
#include <string>

namespace CLI {
class App;
}

namespace orb::cli {

class Command;

using Json = nlohmann::ordered_json;

/// Adds `--format text|json`.
void add_format_option(const Command& command, std::string& format);

/// Adds the fields of a packet by name: numbers and texts. The names of numbers go into a second
/// object.
void put_fields(Json& json, const protocol::Parts& parts);

/// An item found on the wire: a packet with its fields, or bytes outside packets
/// (docs/reference/json.md).
Json packet_json(protocol::Describer& describer, const protocol::Item& item);

/// A message of the ball, in the form of packet_json().
Json message_json(const protocol::Async& message);

/// Prints a value on one line.
void print_json(const Json& json);

} // namespace orb::cli
