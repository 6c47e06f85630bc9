#include "uploader/bluez.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#if defined(ORB_BLE)

#include "uploader/bluez_bus.h"

namespace orb::uploader {
namespace {

using bluez::ble_interrupted;
using bluez::Bus;
using bluez::CallError;
using protocol::BleStep;
using spec::BleCharacteristic;

double in_seconds(Duration time) {
  return static_cast<double>(time.count()) / 1e9;
}

/// Describes a device for lists.
SeenDevice describe_device(const Bus& bus, const std::string& path) {
  SeenDevice device;
  const auto* const interface = bluez::device_interface;
  device.address = bus.get<std::string>(path, interface, "Address").value_or("");
  device.name = bus.get<std::string>(path, interface, "Name").value_or("");
  if (const auto rssi = bus.get<std::int16_t>(path, interface, "RSSI"))
    device.rssi = *rssi;
  device.connected = bus.get<bool>(path, interface, "Connected").value_or(false);
  return device;
}

/// Returns true if the device is in range: it was seen in this scan, or is connected.
bool is_near(const SeenDevice& device) {
  return device.rssi || device.connected;
}

std::string strength(const SeenDevice& device) {
  return device.rssi ? fmt::format("{} dBm", *device.rssi) : std::string("connected");
}

/// A robot as bluetoothd shows it. Large because each step of a connection has its own member and
/// its own failures.
class BluezGatt final : public Gatt {
public:
  explicit BluezGatt(const Endpoint& endpoint) : endpoint_(endpoint) {}
  BluezGatt(const BluezGatt&) = delete;
  BluezGatt& operator=(const BluezGatt&) = delete;

  /// A connected robot stays awake, and nobody else can find it, so disconnect. Leaves a link of
  /// another program alone.
  ~BluezGatt() override { hang_up(); }

  Instant now() const override { return bluez::steady_now(); }

  tl::expected<std::string, BleError> go(BleStep step, const Patience& patience) override {
    switch (step) {
    case BleStep::Bus: return ask_for_daemon(patience);
    case BleStep::Adapter: return choose_adapter();
    case BleStep::Find: return look_for_robot(patience);
    case BleStep::Connect: return connect(patience);
    case BleStep::Services: return resolve(patience);
    case BleStep::AntiDos:
    case BleStep::TxPower:
    case BleStep::Wake:
    case BleStep::Subscribe: break;
    }
    return {};
  }

  bool has(BleCharacteristic characteristic) const override {
    return !path_of(characteristic).empty();
  }

  bool held(BleCharacteristic answers) const override {
    const auto path = path_of(answers);
    const auto is = [&](const char* property) {
      return bus_->get<bool>(path, bluez::characteristic_interface, property).value_or(false);
    };
    return is("Notifying") || is("NotifyAcquired");
  }

  std::string address() const override {
    return bus_ == nullptr || device_.empty() ? std::string()
                                              : describe_device(*bus_, device_).address;
  }

  std::string name() const override {
    return bus_ == nullptr || device_.empty() ? std::string()
                                              : describe_device(*bus_, device_).name;
  }

  void let_go() override { hang_up(); }

  tl::expected<void, BleError> write(BleCharacteristic characteristic, ByteView bytes,
                                     const Patience& patience) override {
    step_ = protocol::step_of(characteristic);
    // A request, which is acknowledged.
    const bluez::Options options{{"type", std::string("request")}};
    const auto written =
        bus_->call(path_of(characteristic), bluez::characteristic_interface, "WriteValue", patience,
                   Bytes(bytes.begin(), bytes.end()), options);
    if (!written || !connected())
      return failed(BleFailure::Refused,
                    step_ ? fmt::format("the robot refused a write while {}", info(*step_).doing)
                          : std::string("the robot does not accept what is written to it"),
                    written ? CallError{} : written.error());
    return {};
  }

  tl::expected<void, BleError> subscribe(BleCharacteristic answers,
                                         const Patience& patience) override {
    step_ = BleStep::Subscribe;
    const auto path = path_of(answers);
    const BleError taken{BleFailure::Held, std::string(held_by_another)};
    // Two programs would each read the answers to both.
    if (held(answers))
      return tl::unexpected(taken);
    bus_->collect(path);
    const auto started = bus_->call(path, bluez::characteristic_interface, "StartNotify", patience);
    if (!started && started.error().is("NotPermitted"))
      return tl::unexpected(taken);
    if (!started || !connected())
      return failed(BleFailure::Refused, "cannot subscribe to the robot's answers",
                    started ? CallError{} : started.error());
    step_.reset();
    ours_ = true;
    return {};
  }

  void rest(const Patience& patience) override {
    static_cast<void>(bus_->wait(patience, [] { return false; }));
  }

  tl::expected<Bytes, BleError> read(Instant deadline) override {
    static_cast<void>(bus_->wait({deadline, {}}, [&] { return bus_->has_bytes() || lost(); }));
    if (bus_->has_bytes())
      return bus_->take();
    if (lost())
      return failed(BleFailure::Lost, "", {});
    return Bytes{};
  }

private:
  void hang_up() {
    if (ours_ && connected())
      static_cast<void>(
          bus_->call(device_, bluez::device_interface, "Disconnect", {now() + 1s, {}}));
    ours_ = false;
  }

  bool flag(const char* property) const {
    return bus_->get<bool>(device_, bluez::device_interface, property).value_or(false);
  }
  bool connected() const { return flag("Connected"); }
  bool lost() const { return !bus_->alive() || !connected(); }

  std::string path_of(BleCharacteristic characteristic) const {
    for (const auto& path : bus_->all(bluez::characteristic_interface))
      if (path.starts_with(device_ + "/") &&
          equal_words(
              bus_->get<std::string>(path, bluez::characteristic_interface, "UUID").value_or(""),
              spec::info(characteristic).uuid))
        return path;
    return {};
  }

  /// Describes a failure by its most basic cause: the adapter first, then the link, then the call
  /// itself.
  tl::unexpected<BleError> failed(BleFailure failure, std::string_view what,
                                  const CallError& call) const {
    if (call.interrupted)
      return tl::unexpected(ble_interrupted());
    if (auto error = bluez::trouble(*bus_, adapter_))
      return tl::unexpected(*std::move(error));
    if (call.is("AccessDenied"))
      return tl::unexpected(BleError{BleFailure::NotAllowed, "no permission to use Bluetooth"});
    if (failure != BleFailure::NotConnected && !connected())
      return tl::unexpected(BleError{
          BleFailure::Lost, step_ ? fmt::format("the link was lost while {}", info(*step_).doing)
                                  : std::string("the link was lost")});
    return tl::unexpected(BleError{failure, call.message.empty()
                                                ? std::string(what)
                                                : fmt::format("{}: {}", what, call.message)});
  }

  tl::expected<std::string, BleError> ask_for_daemon(const Patience& patience) {
    auto bus = Bus::open(patience);
    if (!bus)
      return tl::unexpected(bus.error());
    bus_ = *std::move(bus);
    return std::string("bluetoothd answers");
  }

  tl::expected<std::string, BleError> choose_adapter() {
    auto adapter = bluez::find_adapter(*bus_);
    if (!adapter)
      return adapter;
    adapter_ = *std::move(adapter);
    if (auto error = bluez::trouble(*bus_, adapter_))
      return tl::unexpected(*std::move(error));
    return fmt::format("the adapter {} is on", adapter_.substr(adapter_.rfind('/') + 1));
  }

  bool is_meant(const SeenDevice& device) const {
    return endpoint_.name.empty() ? equal_words(device.address, to_string(endpoint_.address))
                                  : equal_words(device.name, endpoint_.name);
  }

  /// Returns the paths of the devices in range that match.
  std::vector<std::string> candidates() const {
    std::vector<std::string> paths;
    for (const auto& path : bus_->all(bluez::device_interface))
      if (const auto device = describe_device(*bus_, path); is_near(device) && is_meant(device))
        paths.push_back(path);
    return paths;
  }

  tl::expected<std::string, BleError> look_for_robot(const Patience& patience) {
    const auto start = now();
    auto found = candidates();
    if (found.empty()) {
      const bluez::Discovery discovery(*bus_, adapter_, patience);
      if (!discovery.started() && !discovery.started().error().is("InProgress"))
        return failed(BleFailure::NotFound, "cannot start a scan", discovery.started().error());
      static_cast<void>(bus_->wait(patience, [&] {
        found = candidates();
        return !found.empty() || bluez::trouble(*bus_, adapter_);
      }));
      if (found.empty())
        return not_found(patience.deadline - start, patience);
      return meet(found); // only now is the signal strength known
    }
    return meet(found);
  }

  tl::expected<std::string, BleError> meet(const std::vector<std::string>& found) {
    if (found.size() > 1)
      return tl::unexpected(
          BleError{BleFailure::Ambiguous,
                   fmt::format("{} robots are called `{}`", found.size(), endpoint_.name)});
    device_ = found.front();
    const auto device = describe_device(*bus_, device_);
    return fmt::format("{} is nearby ({})", device.name.empty() ? device.address : device.name,
                       strength(device));
  }

  tl::expected<std::string, BleError> not_found(Duration budget, const Patience& patience) const {
    if (patience.stopped())
      return tl::unexpected(ble_interrupted());
    if (auto error = bluez::trouble(*bus_, adapter_))
      return tl::unexpected(*std::move(error));
    std::vector<std::string> names;
    std::size_t others = 0;
    for (const auto& path : bus_->all(bluez::device_interface)) {
      const auto device = describe_device(*bus_, path);
      if (is_near(device) && spec::find_ble_name(device.name) != nullptr)
        names.push_back(fmt::format("{} ({})", device.name, strength(device)));
      else if (is_near(device))
        ++others;
    }
    const auto robots = names.empty() ? std::string(", and no other robot")
                                      : fmt::format(", only {}", fmt::join(names, ", "));
    return tl::unexpected(
        BleError{BleFailure::NotFound,
                 fmt::format("`{}` was not seen within {:.1f} s{}{}",
                             endpoint_.name.empty() ? to_string(endpoint_.address) : endpoint_.name,
                             in_seconds(budget), robots,
                             others > 0 ? fmt::format("; devices that are not robots: {}", others)
                                        : std::string())});
  }

  tl::expected<std::string, BleError> connect(const Patience& patience) {
    step_ = BleStep::Connect;
    const auto before = connected();
    static_cast<void>(bus_->has_risen(device_, "Connected")); // discard earlier changes
    const auto called = bus_->call(device_, bluez::device_interface, "Connect", patience);
    if (!called && !called.error().is("AlreadyConnected")) {
      // An abandoned call continues, so cancel it, but leave a link of another program alone.
      if (!before)
        static_cast<void>(
            bus_->call(device_, bluez::device_interface, "Disconnect", {now() + 1s, {}}));
      return failed(BleFailure::NotConnected, "the connection failed", called.error());
    }
    // The answer may precede the property change, and the link may already be lost again.
    auto risen = before;
    static_cast<void>(bus_->wait(patience, [&] {
      risen = risen || connected() || bus_->has_risen(device_, "Connected");
      return risen || !bus_->alive();
    }));
    if (patience.stopped())
      return tl::unexpected(ble_interrupted());
    if (!risen)
      return failed(BleFailure::NotConnected, "the connection failed", {});
    ours_ = ours_ || !before;
    return std::string(before ? "it was already connected" : "it is connected");
  }

  /// Connect answers before the services are known.
  tl::expected<std::string, BleError> resolve(const Patience& patience) {
    step_ = BleStep::Services;
    const auto start = now();
    static_cast<void>(bus_->wait(patience, [&] { return flag("ServicesResolved") || lost(); }));
    if (patience.stopped())
      return tl::unexpected(ble_interrupted());
    if (lost() || !flag("ServicesResolved"))
      return failed(BleFailure::NotResolved,
                    fmt::format("the robot did not describe its services within {:.1f} s",
                                in_seconds(patience.deadline - start)),
                    {});
    return std::string("its services are known");
  }

  Endpoint endpoint_;
  std::unique_ptr<Bus> bus_;
  std::string adapter_;
  std::string device_;
  bool ours_ = false;           ///< this object made the link to the robot
  std::optional<BleStep> step_; ///< for messages
};

} // namespace

std::optional<BleError> no_ble() {
  return std::nullopt;
}

std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint& endpoint) {
  return std::make_unique<BluezGatt>(endpoint);
}

tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration time, const Budgets& budgets, const StopRequests& stop,
         const std::function<void(std::size_t)>& progress) {
  const Patience answers{bluez::steady_now() + budgets.ble_answer, stop};
  auto bus = Bus::open(answers);
  if (!bus)
    return tl::unexpected(bus.error());
  const auto adapter = bluez::find_adapter(**bus);
  if (!adapter)
    return tl::unexpected(adapter.error());
  if (auto error = bluez::trouble(**bus, *adapter))
    return tl::unexpected(*std::move(error));
  std::map<std::string, SeenDevice> seen; // by path; keeps devices that advertise rarely
  const bluez::Discovery discovery(**bus, *adapter, answers);
  if (!discovery.started() && discovery.started().error().is("AccessDenied"))
    return tl::unexpected(BleError{BleFailure::NotAllowed, "no permission to use Bluetooth"});
  const Patience patience{bluez::steady_now() + time, stop};
  std::optional<BleError> error;
  static_cast<void>((*bus)->wait(patience, [&] {
    for (const auto& path : (*bus)->all(bluez::device_interface))
      if (auto device = describe_device(**bus, path); is_near(device))
        seen[path] = std::move(device);
    progress(seen.size());
    error = bluez::trouble(**bus, *adapter);
    return error.has_value();
  }));
  if (error)
    return tl::unexpected(*std::move(error));
  if (patience.stopped())
    return tl::unexpected(ble_interrupted());
  std::vector<SeenDevice> devices;
  for (auto& [path, device] : seen)
    devices.push_back(std::move(device));
  std::ranges::stable_sort(devices, std::greater(), [](const SeenDevice& device) {
    return device.connected ? 0 : device.rssi.value_or(-1000); // below any real signal
  });
  return devices;
}

} // namespace orb::uploader

#else

#include "uploader/no_gatt.h"

namespace orb::uploader {
namespace {

const BleError not_built{BleFailure::NotBuilt, "this build of orb has no Bluetooth LE"};

} // namespace

std::optional<BleError> no_ble() {
  return not_built;
}

std::unique_ptr<Gatt> make_bluez_gatt(const Endpoint&) {
  return std::make_unique<NoGatt>(not_built);
}

tl::expected<std::vector<SeenDevice>, BleError>
scan_ble(Duration, const Budgets&, const StopRequests&, const std::function<void(std::size_t)>&) {
  return tl::unexpected(not_built);
}

} // namespace orb::uploader

#endif
