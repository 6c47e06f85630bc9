#include "uploader/device_words.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sstream>

namespace orb::uploader {

const std::string_view port_forms =
    "`COM5`, `tcp://host:port`, `replay://file` or `sim:`; `orb ports` lists them";

const std::string_view port_kinds = "COM5, tcp://, sim:";

/// Drops lines about Bluetooth LE, and lines that have become equal to the one before.
std::string with_ports_of_this_system(std::string text) {
  constexpr std::string_view linux_ports[] = {"/dev/rfcomm0", "rfcomm://68:86:E7:00:11:22"};
  std::istringstream lines(text);
  std::string out;
  std::string before;
  for (std::string line; std::getline(lines, line); before = line) {
    for (const auto port : linux_ports)
      if (const auto at = line.find(port); at != line.npos)
        line.replace(at, port.size(), "COM5");
    if (line.find("ble://") == line.npos && (line.empty() || line != before))
      out += line + '\n';
  }
  if (!text.ends_with('\n') && !out.empty())
    out.pop_back();
  return out;
}

bool is_device_name(std::string_view port) {
  constexpr std::string_view com = "COM";
  constexpr std::string_view device = R"(\\.\)";
  if (port.starts_with(device))
    return port.size() > device.size();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return port.size() > com.size() &&
         std::equal(
             com.begin(), com.end(), port.begin(),
             [](char a, char b) { return a == std::toupper(static_cast<unsigned char>(b)); }) &&
         std::all_of(port.begin() + com.size(), port.end(), is_digit);
}

/// The C library has no texts for socket errors.
const char* error_words(int error) {
  switch (error) {
  case ECONNREFUSED: return "connection refused";
  case ETIMEDOUT: return "connection timed out";
  case EHOSTUNREACH: return "no route to host";
  case EAFNOSUPPORT: return "address family not supported by protocol";
  default: return std::strerror(error);
  }
}

std::string open_help(const Endpoint& endpoint, int error) {
  if (endpoint.scheme == Scheme::Pty)
    return "Windows has no pty; a virtual ball is at `sim:`, or at `tcp://127.0.0.1:4242` after "
           "`orb ball --tcp 127.0.0.1:4242`";
  if (endpoint.scheme == Scheme::Rfcomm)
    return "pair the ball in the Windows Bluetooth settings, which gives it a COM port, and "
           "use that port; `orb ports` lists them";
  if (error == ECONNREFUSED && endpoint.scheme == Scheme::Tcp)
    return fmt::format("nothing is listening there; `orb ball --tcp {}:{}` starts a virtual ball",
                       endpoint.host, endpoint.port);
  if (endpoint.scheme == Scheme::Serial && (error == EACCES || error == EBUSY))
    return "another program has it open; close it first";
  if (endpoint.scheme == Scheme::Serial)
    return "shake the ball awake, keep it close, and end other connections to it; `orb ports` "
           "lists "
           "the available ports";
  return "`orb doctor` looks for the cause";
}

} // namespace orb::uploader
