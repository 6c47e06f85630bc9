#if defined(ORB_BLE)

#include "uploader/bluez_bus.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <poll.h>
#include <utility>

namespace orb::uploader::bluez {
namespace {

constexpr auto manager_interface = "org.freedesktop.DBus.ObjectManager";

BleError ble_error(const CallError& error) {
  if (error.interrupted)
    return ble_interrupted();
  if (error.is("AccessDenied"))
    return {BleFailure::NotAllowed, "no permission to use Bluetooth"};
  if (error.name.empty())
    return {BleFailure::NoDaemon, "bluetoothd does not respond"};
  return {BleFailure::NoDaemon, "bluetoothd is not running"};
}

} // namespace

BleError ble_interrupted() {
  return {BleFailure::Interrupted, interrupted_opening};
}

Instant steady_now() {
  return Instant(
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

tl::expected<std::unique_ptr<Bus>, BleError> Bus::open(const Patience& patience) {
  auto bus = std::make_unique<Bus>();
  try {
    bus->connection_ = sdbus::createSystemBusConnection();
    bus->subscribe();
  } catch (const sdbus::Error& error) {
    // A signal also ends the library's own wait; the bus is not to blame.
    if (patience.stopped())
      return tl::unexpected(ble_interrupted());
    return tl::unexpected(BleError{
        BleFailure::NoBus, fmt::format("there is no D-Bus system bus: {}", error.getMessage())});
  }
  if (const auto read = bus->read_objects(patience); !read)
    return tl::unexpected(ble_error(read.error()));
  return bus;
}

void Bus::subscribe() {
  const auto on_signal = [this](sdbus::Message& signal) { take_in(signal); };
  for (const auto* rule :
       {"type='signal',sender='org.bluez',interface='org.freedesktop.DBus.ObjectManager'",
        "type='signal',sender='org.bluez',interface='org.freedesktop.DBus.Properties'",
        "type='signal',sender='org.freedesktop.DBus',member='NameOwnerChanged',arg0='org.bluez'"})
    matches_.push_back(connection_->addMatch(rule, on_signal));
}

tl::expected<void, CallError> Bus::read_objects(const Patience& patience) {
  try {
    const auto proxy = sdbus::createProxy(*connection_, service, "/");
    const auto message = proxy->createMethodCall(manager_interface, "GetManagedObjects");
    return finish(*proxy, message, patience, [this](sdbus::MethodReply& reply) {
      std::map<sdbus::ObjectPath, Interfaces> objects;
      reply >> objects;
      for (auto& [path, interfaces] : objects)
        objects_[path] = std::move(interfaces);
    });
  } catch (const sdbus::Error& error) {
    return tl::unexpected(uncalled(error));
  }
}

/// Describes a call that could not be sent. Listens first, to find out whether the bus itself is
/// gone.
CallError Bus::uncalled(const sdbus::Error& error) {
  static_cast<void>(wait({steady_now(), {}}, [] { return true; }));
  return {error.getName(), error.getMessage()};
}

tl::expected<void, CallError> Bus::finish(sdbus::IProxy& proxy, const sdbus::MethodCall& message,
                                          const Patience& patience, const OnReply& on_reply) {
  std::optional<tl::expected<void, CallError>> result;
  // The wait below has its own limit; this one only has to be later.
  const auto most = std::chrono::duration_cast<std::chrono::microseconds>(
      std::max<Duration>(patience.deadline - steady_now(), {}) + 1s);
  auto pending = proxy.callMethod(
      message,
      [&](sdbus::MethodReply& reply, const sdbus::Error* error) {
        if (error != nullptr) {
          result = tl::unexpected(CallError{error->getName(), error->getMessage()});
          return;
        }
        if (on_reply)
          on_reply(reply);
        result.emplace();
      },
      static_cast<std::uint64_t>(most.count()));
  if (wait(patience, [&] { return result.has_value(); }))
    return *result;
  pending.cancel();
  return tl::unexpected(CallError{{}, "the answer timed out", patience.stopped()});
}

bool Bus::wait(const Patience& patience, const std::function<bool()>& done) {
  while (true) {
    try {
      while (connection_->processPendingRequest())
        ;
      if (done())
        return true;
      const auto left = patience.deadline - steady_now();
      if (left <= Duration{} || patience.stopped())
        return false;
      const auto data = connection_->getEventLoopPollData();
      auto pause = std::min<Duration>(left, stop_notice);
      if (const auto timeout = data.getRelativeTimeout())
        pause = std::min<Duration>(pause, *timeout);
      pollfd query{data.fd, data.events, 0};
      const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(pause).count();
      ::poll(&query, 1, static_cast<int>(milliseconds));
    } catch (const sdbus::Error&) { // the bus itself is gone
      alive_ = false;
      return done();
    }
  }
}

const Properties* Bus::find(const std::string& path, const std::string& interface) const {
  const auto object = objects_.find(path);
  if (object == objects_.end())
    return nullptr;
  const auto at = object->second.find(interface);
  return at == object->second.end() ? nullptr : &at->second;
}

std::vector<std::string> Bus::all(const std::string& interface) const {
  std::vector<std::string> paths;
  for (const auto& [path, interfaces] : objects_)
    if (interfaces.contains(interface))
      paths.push_back(path);
  return paths;
}

void Bus::take_in(sdbus::Message& signal) {
  const auto member = signal.getMemberName();
  if (member == "PropertiesChanged") {
    std::string interface;
    Properties changed;
    std::vector<std::string> gone;
    signal >> interface >> changed >> gone;
    auto& properties = objects_[signal.getPath()][interface];
    for (auto& [name, value] : changed) {
      if (name == "Value" && signal.getPath() == collected_from_) {
        const auto bytes = value.get<Bytes>();
        collected_.insert(collected_.end(), bytes.begin(), bytes.end());
      }
      if (value.containsValueOfType<bool>() && value.get<bool>())
        risen_.emplace(signal.getPath(), name);
      properties[name] = value;
    }
    for (const auto& name : gone)
      properties.erase(name);
  } else if (member == "InterfacesAdded") {
    sdbus::ObjectPath path;
    Interfaces interfaces;
    signal >> path >> interfaces;
    for (auto& [name, properties] : interfaces)
      objects_[path][name] = std::move(properties);
  } else if (member == "InterfacesRemoved") {
    sdbus::ObjectPath path;
    std::vector<std::string> interfaces;
    signal >> path >> interfaces;
    for (const auto& name : interfaces)
      objects_[path].erase(name);
  } else if (member == "NameOwnerChanged") {
    std::string name, before, after;
    signal >> name >> before >> after;
    alive_ = !after.empty();
    if (!alive_)
      objects_.clear();
  }
}

tl::expected<std::string, BleError> find_adapter(const Bus& bus) {
  const auto adapters = bus.all(adapter_interface);
  if (adapters.empty())
    return tl::unexpected(BleError{BleFailure::NoAdapter, "no Bluetooth adapter found"});
  for (const auto& path : adapters)
    if (bus.get<bool>(path, adapter_interface, "Powered").value_or(false))
      return path;
  return adapters.front();
}

std::optional<BleError> trouble(const Bus& bus, const std::string& adapter) {
  if (!bus.alive())
    return BleError{BleFailure::NoDaemon, "bluetoothd has exited"};
  const auto name = adapter.substr(adapter.rfind('/') + 1);
  if (bus.find(adapter, adapter_interface) == nullptr)
    return BleError{BleFailure::AdapterGone, fmt::format("the adapter {} is gone", name)};
  if (!bus.get<bool>(adapter, adapter_interface, "Powered").value_or(false))
    return BleError{BleFailure::AdapterOff, fmt::format("the adapter {} is off", name)};
  return std::nullopt;
}

Discovery::Discovery(Bus& bus, std::string adapter, const Patience& patience)
    : bus_(bus), adapter_(std::move(adapter)) {
  // No filter by services: no document says which ones robots advertise.
  const Options filter{{"Transport", std::string("le")}};
  static_cast<void>(bus_.call(adapter_, adapter_interface, "SetDiscoveryFilter", patience, filter));
  started_ = bus_.call(adapter_, adapter_interface, "StartDiscovery", patience);
}

Discovery::~Discovery() {
  // Discovery would end with this program, but connecting is faster once it has stopped.
  if (started_)
    static_cast<void>(
        bus_.call(adapter_, adapter_interface, "StopDiscovery", {steady_now() + 1s, {}}));
}

} // namespace orb::uploader::bluez

#endif
