#pragma once

#include "uploader/endpoint.h"

#include <string>
#include <string_view>

// System-specific names of devices, and remedies if one does not open.

namespace orb::uploader {

/// Returns true if a port is a bare device name, as users write it.
bool is_device_name(std::string_view port);

/// Forms of ports, for messages.
extern const std::string_view port_forms;

/// Beginnings of ports, for help.
extern const std::string_view port_kinds;

/// Replaces the Linux ports in a text by examples for this system.
std::string with_ports_of_this_system(std::string text);

/// Returns the text of an errno value.
const char* error_words(int error);

/// Returns what to do about a link that could not be opened; `error` is an errno value.
std::string open_help(const Endpoint& endpoint, int error);

} // namespace orb::uploader
