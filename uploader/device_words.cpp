#include "uploader/device_words.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace orb::uploader {

const std::string_view port_forms =
    "`/dev/rfcomm0`, `serial:///dev/rfcomm0`, `rfcomm://AA:BB:CC:DD:EE:FF`, `ble://NAME`, "
    "`tcp://host:port`, `pty:///path`, `replay://file` or `sim:`";

const std::string_view port_kinds = "a path, rfcomm://, ble://, tcp://, pty://, sim:";

std::string with_ports_of_this_system(std::string text) {
  return text;
}

bool is_device_name(std::string_view port) {
  return port.find(':') == port.npos && port.find('/') != port.npos;
}

const char* error_words(int error) {
  return std::strerror(error);
}

std::string open_help(const Endpoint& endpoint, int error) {
  const auto is_node = endpoint.scheme == Scheme::Serial || endpoint.scheme == Scheme::Pty;
  if (error == EACCES || error == EPERM)
    return "add yourself to group `dialout`: `sudo usermod -aG dialout $USER`, then log in again";
  if (error == ENOENT && endpoint.scheme == Scheme::Pty)
    return "start a virtual ball with `orb ball --pty`; it prints its path";
  if (error == ENOENT || error == ENXIO || error == ENODEV)
    return "`orb ports` lists what there is; a paired ball gets a port with `sudo rfcomm bind 0 "
           "AA:BB:CC:DD:EE:FF 1`";
  if (error == EBUSY || error == EWOULDBLOCK)
    return is_node
               ? fmt::format("another program has it open; `fuser -v {}` names it", endpoint.path)
               : "another program is connected to this ball; close it first";
  if (error == EISDIR)
    return "give the path of a device, such as `/dev/rfcomm0`; `orb ports` lists them";
  if (error == ENOTTY || error == EINVAL)
    return "this is not a serial device; `orb ports` lists them";
  if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT)
    return "this system has no Bluetooth sockets; use a serial port (`rfcomm bind`) or a relay "
           "(`socat FILE:/dev/rfcomm0,raw TCP-LISTEN:4242`)";
  if (error == ECONNREFUSED && endpoint.scheme == Scheme::Tcp)
    return fmt::format("nothing is listening there; `orb ball --tcp {}:{}` starts a virtual ball",
                       endpoint.host, endpoint.port);
  if (endpoint.scheme == Scheme::Rfcomm)
    return "shake the ball awake, keep it close, and end other connections to it";
  return "`orb doctor` looks for the cause";
}

} // namespace orb::uploader
