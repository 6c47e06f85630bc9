#include "uploader/endpoint.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "uploader/device_words.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace orb::uploader {
namespace {

constexpr std::array<std::string_view, 7> schemes = {"serial://", "rfcomm://", "ble://", "tcp://",
                                                     "pty://",    "replay://", "sim:"};
constexpr std::uint8_t channel_most = 30; // RFCOMM server channels are 1 to 30

tl::unexpected<std::string> wrong(std::string_view url, std::string_view what) {
  return tl::unexpected(fmt::format("`{}` is not a port: {}", url, what));
}

std::optional<unsigned> read_number(std::string_view text, int base, unsigned most) {
  const auto value = parse_number<unsigned>(text, base);
  return value && *value <= most ? value : std::nullopt;
}

constexpr std::size_t address_size = 17; // of the text AA:BB:CC:DD:EE:FF

tl::expected<Endpoint, std::string> read_rfcomm(Endpoint endpoint, std::string_view rest) {
  const auto address = parse_bluetooth_address(rest.substr(0, address_size));
  if (!address)
    return wrong(endpoint.text, "a Bluetooth address is written `rfcomm://AA:BB:CC:DD:EE:FF`");
  endpoint.address = *address;
  rest.remove_prefix(address_size);
  if (rest.empty())
    return endpoint;
  const auto channel =
      rest.front() == '/' ? read_number(rest.substr(1), 10, channel_most) : std::nullopt;
  if (!channel || *channel == 0)
    return wrong(endpoint.text, "a channel from 1 to 30 may follow the address, as in `/1`");
  endpoint.channel = static_cast<std::uint8_t>(*channel);
  return endpoint;
}

tl::expected<Endpoint, std::string> read_tcp(Endpoint endpoint, std::string_view rest) {
  constexpr unsigned port_most = UINT16_MAX;
  const auto colon = rest.rfind(':');
  const auto port =
      colon == rest.npos ? std::nullopt : read_number(rest.substr(colon + 1), 10, port_most);
  auto host = rest.substr(0, colon == rest.npos ? 0 : colon);
  if (host.starts_with("[") && host.ends_with("]"))
    host = host.substr(1, host.size() - 2);
  if (!port || *port == 0 || host.empty())
    return wrong(endpoint.text, "a TCP port is written `tcp://host:port`, such as "
                                "`tcp://127.0.0.1:4242`");
  endpoint.host = host;
  endpoint.port = static_cast<std::uint16_t>(*port);
  return endpoint;
}

tl::expected<Endpoint, std::string> read_ble(Endpoint endpoint, std::string_view rest) {
  if (rest.empty())
    return wrong(endpoint.text, "write `ble://` and the robot's name or address, such as "
                                "`ble://SK-1A2B`; `orb ports` lists them");
  if (const auto address = parse_bluetooth_address(rest))
    endpoint.address = *address;
  else if (rest.find_first_of(":/") != rest.npos) // cannot be a robot's name
    return wrong(endpoint.text, "a Bluetooth address is written `ble://AA:BB:CC:DD:EE:FF`");
  else
    endpoint.name = rest;
  return endpoint;
}

tl::expected<Endpoint, std::string> read_path(Endpoint endpoint, std::string_view rest) {
  if (rest.empty())
    return wrong(endpoint.text, "missing path");
  endpoint.path = rest;
  return endpoint;
}

} // namespace

std::optional<BluetoothAddress> parse_bluetooth_address(std::string_view text) {
  if (text.size() != address_size)
    return std::nullopt;
  BluetoothAddress address{};
  for (std::size_t i = 0; i < address.size(); ++i) {
    const auto byte = read_number(text.substr(i * 3, 2), 16, UINT8_MAX);
    if (!byte || (i > 0 && text[i * 3 - 1] != ':'))
      return std::nullopt;
    address[i] = static_cast<std::uint8_t>(*byte);
  }
  return address;
}

std::string to_string(const BluetoothAddress& address) {
  return fmt::format("{:02X}", fmt::join(address, ":"));
}

tl::expected<Endpoint, std::string> parse_endpoint(std::string_view url) {
  Endpoint endpoint;
  endpoint.text = url;
  const auto rest_of = [&](std::string_view scheme) { return url.substr(scheme.size()); };
  if (url == "sim:" || url == "sim")
    return endpoint;
  if (url.starts_with("serial://")) {
    endpoint.scheme = Scheme::Serial;
    return read_path(endpoint, rest_of("serial://"));
  }
  if (url.starts_with("pty://")) {
    endpoint.scheme = Scheme::Pty;
    return read_path(endpoint, rest_of("pty://"));
  }
  if (url.starts_with("replay://")) {
    endpoint.scheme = Scheme::Replay;
    return read_path(endpoint, rest_of("replay://"));
  }
  if (url.starts_with("rfcomm://")) {
    endpoint.scheme = Scheme::Rfcomm;
    return read_rfcomm(endpoint, rest_of("rfcomm://"));
  }
  if (url.starts_with("ble://")) {
    endpoint.scheme = Scheme::Ble;
    return read_ble(endpoint, rest_of("ble://"));
  }
  if (url.starts_with("tcp://")) {
    endpoint.scheme = Scheme::Tcp;
    return read_tcp(endpoint, rest_of("tcp://"));
  }
  if (is_device_name(url)) {
    endpoint.scheme = Scheme::Serial;
    return read_path(endpoint, url);
  }
  if (parse_bluetooth_address(url))
    return wrong(
        url, fmt::format("a Sphero is `rfcomm://{0}`; a SPRK+, BB-8 or Ollie is `ble://{0}`", url));
  if (spec::find_ble_name(url) != nullptr)
    return wrong(url, fmt::format("did you mean `ble://{}`?", url));
  const auto colon = url.find("://");
  const auto word = colon == url.npos ? url : url.substr(0, colon + 3);
  return wrong(url, did_you_mean(word, schemes, fmt::format("it is written {}", port_forms)));
}

std::array<std::uint8_t, 10> rfcomm_socket_address(const BluetoothAddress& address,
                                                   std::uint8_t channel) {
  std::array<std::uint8_t, 10> bytes{};
  constexpr std::uint16_t family = 31; // AF_BLUETOOTH on Linux
  std::memcpy(bytes.data(), &family, sizeof(family));
  std::reverse_copy(address.begin(), address.end(), bytes.begin() + sizeof(family));
  bytes[sizeof(family) + address.size()] = channel;
  return bytes;
}

protocol::LinkError describe_open_error(const Endpoint& endpoint, int error) {
  const auto is_node = endpoint.scheme == Scheme::Serial || endpoint.scheme == Scheme::Pty;
  const auto& name = is_node ? endpoint.path : endpoint.text;
  const auto* what = error == EWOULDBLOCK ? "in use" : error_words(error);
  std::string seen = what;
  if (seen.size() > 1 && seen[1] >= 'a')
    seen[0] = to_lower(seen[0]);
  return {protocol::LinkError::Kind::CannotOpen,
          fmt::format("cannot open {}: {}; {}", name, seen, open_help(endpoint, error))};
}

} // namespace orb::uploader
