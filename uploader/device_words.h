#pragma once

#include "uploader/endpoint.h"

#include <string>
#include <string_view>

// How devices are called on this system, and what helps where one does not open.

namespace orb::uploader {

/// Whether a port is the bare name of a device, as users write it.
bool is_device_name(std::string_view port);

/// How ports are written, for messages.
extern const std::string_view port_forms;

/// What a port begins with, for help.
extern const std::string_view port_kinds;

/// A text with examples of ports, which is written for Linux, with those of this system.
std::string with_ports_of_this_system(std::string text);

/// An error as errno has it, in words.
const char* error_words(int error);

/// What to do about a link that could not be opened; `error` as errno has it.
std::string open_help(const Endpoint& endpoint, int error);

} // namespace orb::uploader
