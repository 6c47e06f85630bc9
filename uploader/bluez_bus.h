#pragma once

#include "base/text/text.h"
#include "uploader/gatt.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sdbus-c++/sdbus-c++.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// bluetoothd as a tree of objects with properties. Only files named bluez… use D-Bus.
namespace orb::uploader::bluez {

inline constexpr auto service = "org.bluez";
inline constexpr auto adapter_interface = "org.bluez.Adapter1";
inline constexpr auto device_interface = "org.bluez.Device1";
inline constexpr auto characteristic_interface = "org.bluez.GattCharacteristic1";

using Properties = std::map<std::string, sdbus::Variant>;
using Interfaces = std::map<std::string, Properties>;
using Options = Properties; ///< of a method

/// The error answer to a call.
struct CallError {
  std::string name; ///< for example `org.bluez.Error.Failed`; empty if no answer came in time
  std::string message;
  bool interrupted = false;

  bool is(std::string_view last) const { return name.ends_with(last); }
};

/// The connection, with a copy of bluetoothd's objects that signals keep up to date. There is no
/// thread: signals are processed during waits.
class Bus {
public:
  /// Connects and reads all objects.
  static tl::expected<std::unique_ptr<Bus>, BleError> open(const Patience& patience);

  /// Waits until `done` returns true. Returns false if the patience ends first.
  bool wait(const Patience& patience, const std::function<bool()>& done);

  /// Calls a method that returns nothing.
  template <class... Arguments>
  tl::expected<void, CallError> call(const std::string& path, const std::string& interface,
                                     const std::string& method, const Patience& patience,
                                     const Arguments&... arguments) {
    try {
      const auto proxy = sdbus::createProxy(*connection_, service, path);
      auto message = proxy->createMethodCall(interface, method);
      static_cast<void>((message << ... << arguments));
      return finish(*proxy, message, patience, {});
    } catch (const sdbus::Error& error) {
      return tl::unexpected(uncalled(error));
    }
  }

  /// Returns the properties of an object; null if it does not exist.
  const Properties* find(const std::string& path, const std::string& interface) const;

  /// Returns the paths of the objects with this interface, in order.
  std::vector<std::string> all(const std::string& interface) const;

  template <class Value>
  std::optional<Value> get(const std::string& path, const std::string& interface,
                           const std::string& property) const {
    const auto* properties = find(path, interface);
    if (properties == nullptr)
      return std::nullopt;
    const auto at = properties->find(property);
    if (at == properties->end() || !at->second.template containsValueOfType<Value>())
      return std::nullopt;
    return at->second.template get<Value>();
  }

  /// Returns true if the property became true since the last call, whatever it is now. Thus a brief
  /// change between two calls is not missed.
  bool has_risen(const std::string& path, const std::string& property) {
    return risen_.erase({path, property}) > 0;
  }

  /// Returns true if bluetoothd is still running.
  bool alive() const { return alive_; }

  /// Collects the notifications of the characteristic at `path`.
  void collect(std::string path) { collected_from_ = std::move(path); }
  /// Returns the bytes notified since the last take().
  Bytes take() { return std::exchange(collected_, {}); }
  bool has_bytes() const { return !collected_.empty(); }

private:
  using OnReply = std::function<void(sdbus::MethodReply&)>;

  tl::expected<void, CallError> finish(sdbus::IProxy& proxy, const sdbus::MethodCall& message,
                                       const Patience& patience, const OnReply& on_reply);
  CallError uncalled(const sdbus::Error& error);
  tl::expected<void, CallError> read_objects(const Patience& patience);
  void subscribe();
  void take_in(sdbus::Message& signal);

  std::unique_ptr<sdbus::IConnection> connection_;
  std::vector<sdbus::Slot> matches_;
  std::map<std::string, Interfaces> objects_;
  std::set<std::pair<std::string, std::string>> risen_; ///< paths and properties
  bool alive_ = true;
  std::string collected_from_;
  Bytes collected_;
};

/// The error for a wait stopped by the user.
BleError ble_interrupted();

/// Returns the steady clock as an Instant.
Instant steady_now();

/// Returns the first adapter that is on, otherwise the first.
tl::expected<std::string, BleError> find_adapter(const Bus& bus);

/// Returns what is wrong with the bus or the adapter; nullopt if nothing is.
std::optional<BleError> trouble(const Bus& bus, const std::string& adapter);

/// Scans for advertising devices while this object lives.
class Discovery {
public:
  Discovery(Bus& bus, std::string adapter, const Patience& patience);
  ~Discovery();
  Discovery(const Discovery&) = delete;
  Discovery& operator=(const Discovery&) = delete;
  const tl::expected<void, CallError>& started() const { return started_; }

private:
  Bus& bus_;
  std::string adapter_;
  tl::expected<void, CallError> started_;
};

} // namespace orb::uploader::bluez
