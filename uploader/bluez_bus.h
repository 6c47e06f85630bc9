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

/// bluetoothd as a tree of objects with properties. Only files named bluez… see D-Bus.
namespace orb::uploader::bluez {

inline constexpr auto service = "org.bluez";
inline constexpr auto adapter_interface = "org.bluez.Adapter1";
inline constexpr auto device_interface = "org.bluez.Device1";
inline constexpr auto characteristic_interface = "org.bluez.GattCharacteristic1";

using Properties = std::map<std::string, sdbus::Variant>;
using Interfaces = std::map<std::string, Properties>;
using Options = Properties; ///< of a method

/// What a call was answered with where it failed.
struct CallError {
  std::string name; ///< such as `org.bluez.Error.Failed`; empty where no answer came in time
  std::string message;
  bool interrupted = false;

  bool is(std::string_view last) const { return name.ends_with(last); }
};

/// The connection, with a copy of bluetoothd's objects that its signals keep up to date. It has no
/// thread: signals are taken in while something is waited for.
class Bus {
public:
  /// Connects and reads all objects.
  static tl::expected<std::unique_ptr<Bus>, BleError> open(const Patience& patience);

  /// Waits until `done`; false when patience ends first.
  bool wait(const Patience& patience, const std::function<bool()>& done);

  /// Calls a method that answers nothing.
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

  /// Null where there is no such object.
  const Properties* find(const std::string& path, const std::string& interface) const;

  /// The paths of the objects that have the interface, in their order.
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

  /// Whether the property has become true since this was last asked, whatever it is now: what comes
  /// and goes between two looks is not missed.
  bool has_risen(const std::string& path, const std::string& property) {
    return risen_.erase({path, property}) > 0;
  }

  /// Whether bluetoothd is still there.
  bool alive() const { return alive_; }

  /// Keeps the values that the characteristic at `path` notifies of.
  void collect(std::string path) { collected_from_ = std::move(path); }
  /// The bytes that were notified of since the last take().
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

/// That nobody waits any more.
BleError ble_interrupted();

/// The steady clock as an Instant.
Instant steady_now();

/// The first adapter that is on, else the first.
tl::expected<std::string, BleError> find_adapter(const Bus& bus);

/// What is wrong with the bus or the adapter, if anything is.
std::optional<BleError> trouble(const Bus& bus, const std::string& adapter);

/// Lets the adapter listen for what advertises itself, as long as it lives.
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
