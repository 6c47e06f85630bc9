#include "serve/fake_bluez.h"

#include <fmt/format.h>

#if defined(ORB_BLE)

#include "base/random.h"
#include "serve/descriptor_link.h"
#include "serve/private_bus.h"
#include "vm/common/bluetooth.h"

#include <algorithm>
#include <array>
#include <asio/steady_timer.hpp>
#include <map>
#include <sdbus-c++/sdbus-c++.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace orb::serve {
namespace {

using protocol::BleStep;
using spec::BleCharacteristic;
using Properties = std::map<std::string, sdbus::Variant>;

constexpr auto service_name = "org.bluez";
constexpr auto adapter_interface = "org.bluez.Adapter1";
constexpr auto device_interface = "org.bluez.Device1";
constexpr auto service_interface = "org.bluez.GattService1";
constexpr auto characteristic_interface = "org.bluez.GattCharacteristic1";
constexpr auto agents_interface = "org.bluez.AgentManager1"; // programs detect BlueZ by it
constexpr auto agents_path = "/org/bluez";
constexpr auto adapter_path = "/org/bluez/hci0";
constexpr auto adapter_address = "00:11:22:33:44:55"; // not assigned to anybody

/// A device appears before its name is known.
constexpr auto seen_after = std::chrono::milliseconds{20};
constexpr auto named_after = std::chrono::milliseconds{20};
constexpr std::int16_t strongest = -48; // dBm; each further robot is farther away
constexpr std::int16_t farther = 7;     // dB

constexpr double half = 0.5;

sdbus::Error bluez_error(std::string_view name, const std::string& message) {
  return {fmt::format("org.bluez.Error.{}", name), message};
}

sdbus::Error not_connected() {
  return bluez_error("Failed", "Not connected");
}

/// Emits changed and removed properties. Written by hand, because removed properties sometimes
/// cannot be reported otherwise.
void tell(sdbus::IObject& object, const std::string& interface, const Properties& changed,
          const std::vector<std::string>& gone = {}) {
  auto signal = object.createSignal("org.freedesktop.DBus.Properties", "PropertiesChanged");
  signal << interface << changed << gone;
  object.emitSignal(signal);
}

/// Registers a property with a constant value.
template <class Value>
void constant(sdbus::IObject& object, const char* interface, const char* name, Value value) {
  object.registerProperty(name).onInterface(interface).withGetter(
      [value = std::move(value)] { return value; });
}

class Robot;

/// bluetoothd and the adapter. Large because its robots share the adapter, the bus, the scans and
/// the faults.
class Computer final : public FakeBluez {
public:
  Computer(asio::io_context& io, const protocol::BleFaultPlan& plan)
      : io_(io), plan_(plan), socket_(io) {}
  Computer(const Computer&) = delete;
  Computer& operator=(const Computer&) = delete;
  ~Computer() override { socket_.release(); }

  tl::expected<void, IoError> open() override;
  std::unique_ptr<Link> make_robot(std::string name, std::string address,
                                   spec::BleModel model) override;
  std::string bus() const { return bus_.address(); }

  void add(Robot& robot) { robots_.push_back(&robot); }
  void remove(Robot& robot) { std::erase(robots_, &robot); }
  /// Signal strength of a robot.
  std::int16_t strength(const Robot& robot) const;
  bool listens() const { return !listeners_.empty(); }
  /// Returns true if the adapter can hold another connection.
  bool has_link() const;

  asio::io_context& io() { return io_; }
  const protocol::BleFaultPlan& plan() const { return plan_; }
  /// A separate stream per robot, so that faults do not hit all robots alike.
  Random make_random() { return {plan_.seed + made_++}; }
  sdbus::IConnection& connection() { return *connection_; }

  /// Runs `act` later.
  void after(Duration time, std::function<void()> act);
  /// Simulates unplugging the adapter.
  void vanish();

private:
  void pump();
  void publish();
  void start_discovery(const std::string& client);
  void stop_discovery(const std::string& client);
  void forget(const std::string& client);

  asio::io_context& io_;
  const protocol::BleFaultPlan& plan_;
  std::uint64_t made_ = 0; ///< robots so far
  PrivateBus bus_;
  std::unique_ptr<sdbus::IConnection> connection_;
  asio::posix::stream_descriptor socket_;  ///< the connection's own
  std::unique_ptr<sdbus::IObject> agents_; ///< exists only to be found: robots are not paired
  std::unique_ptr<sdbus::IObject> adapter_;
  std::vector<std::string> listeners_; ///< clients that scan
  std::vector<Robot*> robots_;
};

/// A robot: its device and characteristics on the bus, and the client's end of a link to the ball.
/// Large because it answers BlueZ's calls, passes on the ball's bytes and injects faults between
/// them.
class Robot final : public DescriptorLink {
public:
  Robot(Computer& computer, std::string name, const std::string& address, spec::BleModel model)
      : DescriptorLink(computer.io()), computer_(computer), name_(std::move(name)), model_(model),
        protocol_(computer.plan().newer ? spec::BleProtocol::V2 : spec::info(model).protocol),
        address_(vm::with_colons(address)), random_(computer.make_random()), peer_(computer.io()),
        drop_once_(computer.plan().drop_once), balk_once_(computer.plan().balk_once) {
    if (computer_.plan().undriven)
      name_.replace(0, name_.find('-') + 1, spec::info(spec::BleModel::McQueen).prefix);
    path_ = fmt::format("{}/dev_{}", adapter_path, address_);
    std::ranges::replace(path_, ':', '_');
    computer_.add(*this);
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() override { computer_.remove(*this); }

  std::string address() const override {
    return fmt::format("ble ble://{} DBUS_SYSTEM_BUS_ADDRESS={}", name_, computer_.bus());
  }
  void start(Door& door) override { door_ = &door; }
  void hang_up() override {
    stream_.close();
    disconnect();
  }
  bool can_hang_up() const override { return true; }

  /// Appears in a scan: first without its name.
  void advertise();
  /// Removes the signal strength, because no client scans any more.
  void fade();
  void forget(const std::string& client);
  void unpublish();
  bool connected() const { return connected_; }

private:
  struct Characteristic {
    std::unique_ptr<sdbus::IObject> object;
    std::string notified; ///< client subscribed to notifications; empty: none
  };
  using Result = sdbus::Result<>;

  void publish_device();
  void publish_services();
  void publish_characteristic(const spec::BleCharacteristicInfo& row, std::size_t number);
  bool publishes(const spec::BleCharacteristicInfo& row) const;

  void connect(Result&& result);
  void disconnect();
  void resolve();
  /// Returns true if the plan ends the link in this step. The link has then been ended.
  bool strikes(BleStep step, Result& result);
  bool strikes(BleStep step);
  /// Returns true if the plan makes this step fail but keeps the link.
  bool balks(BleStep step);
  /// Stores the result of a call and passes it to `answer` later.
  void keep(Result&& result, Duration time, std::function<void(Result&)> answer);

  void on_write(BleCharacteristic characteristic, const Bytes& value, Result&& result);
  void take(BleCharacteristic characteristic, const Bytes& value);
  void start_notify(BleCharacteristic characteristic, Result&& result);
  void stop_notify(BleCharacteristic characteristic);
  void set_notified(BleCharacteristic characteristic, const std::string& client);
  void await_packets();
  void notify(ByteView bytes);

  Computer& computer_;
  std::string name_;
  spec::BleModel model_;
  spec::BleProtocol protocol_;
  std::string address_;
  std::string path_;
  Door* door_ = nullptr;
  Random random_;
  asio::posix::stream_descriptor peer_;
  std::unique_ptr<sdbus::IObject> device_;
  std::vector<std::unique_ptr<sdbus::IObject>> services_;
  std::map<BleCharacteristic, Characteristic> characteristics_;
  std::array<std::uint8_t, 4096> buffer_{}; // bytes; more than a ball sends at once
  std::optional<BleStep> drop_once_;
  std::optional<BleStep> balk_once_;
  /// Unanswered calls by number. None may outlive the connection.
  std::map<std::uint64_t, Result> kept_;
  std::uint64_t calls_ = 0;
  bool known_ = false; ///< its name is known
  bool heard_ = false; ///< its signal strength is known
  bool connected_ = false;
  bool resolved_ = false;
  bool greeted_ = false; ///< the right word was written
  std::uint64_t session_ = 0;
};

// The computer.

tl::expected<void, IoError> Computer::open() {
  if (auto started = bus_.start(plan_.denied ? service_name : ""); !started)
    return started;
  if (plan_.no_daemon)
    return {};
  try {
    connection_ = sdbus::createSessionBusConnectionWithAddress(bus_.address());
    connection_->requestName(service_name);
    connection_->addObjectManager("/", sdbus::floating_slot);
    connection_->addMatch(
        "type='signal',sender='org.freedesktop.DBus',member='NameOwnerChanged'",
        [this](sdbus::Message& signal) {
          std::string name, before, now;
          signal >> name >> before >> now;
          if (now.empty())
            forget(name);
        },
        sdbus::floating_slot);
    agents_ = sdbus::createObject(*connection_, agents_path);
    agents_->registerMethod("RequestDefaultAgent")
        .onInterface(agents_interface)
        .implementedAs([](const sdbus::ObjectPath&) {});
    agents_->finishRegistration();
    if (!plan_.no_adapter)
      publish();
    socket_.assign(connection_->getEventLoopPollData().fd);
  } catch (const sdbus::Error& error) {
    return tl::unexpected(IoError{"cannot act as bluetoothd: " + error.getMessage()});
  }
  pump();
  return {};
}

void Computer::publish() {
  adapter_ = sdbus::createObject(*connection_, adapter_path);
  auto& adapter = *adapter_;
  const auto client = [&adapter] { return adapter.getCurrentlyProcessedMessage()->getSender(); };
  adapter.registerMethod("SetDiscoveryFilter")
      .onInterface(adapter_interface)
      .implementedAs([](const Properties&) {});
  adapter.registerMethod("StartDiscovery").onInterface(adapter_interface).implementedAs([=, this] {
    start_discovery(client());
  });
  adapter.registerMethod("StopDiscovery").onInterface(adapter_interface).implementedAs([=, this] {
    stop_discovery(client());
  });
  adapter.registerMethod("RemoveDevice")
      .onInterface(adapter_interface)
      .implementedAs([](const sdbus::ObjectPath&) {});
  constant(adapter, adapter_interface, "Address", std::string(adapter_address));
  constant(adapter, adapter_interface, "Name", std::string("orb"));
  constant(adapter, adapter_interface, "Alias", std::string("orb"));
  constant(adapter, adapter_interface, "Powered", !plan_.adapter_off);
  adapter.registerProperty("Discovering").onInterface(adapter_interface).withGetter([this] {
    return listens();
  });
  adapter.finishRegistration();
}

/// Processes everything received on the bus, then waits for more.
void Computer::pump() {
  try {
    while (connection_->processPendingRequest())
      ;
    const auto again = [this](asio::error_code error) {
      if (!error)
        pump();
    };
    socket_.cancel();
    socket_.async_wait(asio::posix::descriptor_base::wait_read, again);
    constexpr short write_event = 4; // POLLOUT: output is pending
    if ((connection_->getEventLoopPollData().events & write_event) != 0)
      socket_.async_wait(asio::posix::descriptor_base::wait_write, again);
  } catch (const sdbus::Error&) {
    // The bus is gone, and with it all clients.
  }
}

void Computer::after(Duration time, std::function<void()> act) {
  auto timer = std::make_unique<asio::steady_timer>(io_, time);
  auto& waiting = *timer;
  waiting.async_wait([timer = std::move(timer), act = std::move(act)](asio::error_code error) {
    if (!error)
      act();
  });
}

std::int16_t Computer::strength(const Robot& robot) const {
  const auto at = std::ranges::find(robots_, &robot) - robots_.begin();
  return static_cast<std::int16_t>(strongest - farther * at);
}

bool Computer::has_link() const {
  const auto taken =
      std::ranges::count_if(robots_, [](const Robot* robot) { return robot->connected(); });
  return plan_.links == 0 || static_cast<std::size_t>(taken) < plan_.links;
}

void Computer::start_discovery(const std::string& client) {
  if (std::ranges::find(listeners_, client) != listeners_.end())
    throw bluez_error("InProgress", "Operation already in progress");
  listeners_.push_back(client);
  after(seen_after, [this] {
    if (listens() && !plan_.away)
      for (auto* robot : robots_)
        robot->advertise();
  });
}

void Computer::stop_discovery(const std::string& client) {
  std::erase(listeners_, client);
  if (!listens())
    for (auto* robot : robots_)
      robot->fade();
}

/// Drops a client and what it had requested.
void Computer::forget(const std::string& client) {
  if (std::ranges::find(listeners_, client) != listeners_.end())
    stop_discovery(client);
  for (auto* robot : robots_)
    robot->forget(client);
}

void Computer::vanish() {
  for (auto* robot : robots_)
    robot->unpublish();
  if (adapter_) {
    adapter_->emitInterfacesRemovedSignal();
    adapter_.reset();
  }
}

// The robot on the bus.

void Robot::advertise() {
  if (connected_)
    return;
  if (!device_) {
    publish_device();
    device_->emitInterfacesAddedSignal();
  }
  computer_.after(named_after, [this] {
    if (!device_ || !computer_.listens())
      return;
    known_ = heard_ = true;
    publish_device();
    tell(*device_, device_interface,
         {{"Name", name_}, {"Alias", name_}, {"RSSI", computer_.strength(*this)}});
  });
}

void Robot::fade() {
  if (!std::exchange(heard_, false) || !device_)
    return;
  publish_device();
  tell(*device_, device_interface, {}, {"RSSI"});
}

/// Publishes the device again, because its set of properties changes.
void Robot::publish_device() {
  device_.reset();
  device_ = sdbus::createObject(computer_.connection(), path_);
  auto& device = *device_;
  device.registerMethod("Connect").onInterface(device_interface).implementedAs([this](Result&& r) {
    connect(std::move(r));
  });
  // Answer first: a client that sees the link end may not wait for the answer.
  device.registerMethod("Disconnect")
      .onInterface(device_interface)
      .implementedAs([this](Result&& r) {
        r.returnResults();
        disconnect();
      });
  constant(device, device_interface, "Address", address_);
  constant(device, device_interface, "AddressType", std::string("random"));
  constant(device, device_interface, "Adapter", sdbus::ObjectPath(adapter_path));
  constant(device, device_interface, "UUIDs", std::vector<std::string>());
  for (const auto* name : {"Paired", "Trusted", "Blocked", "LegacyPairing"})
    constant(device, device_interface, name, false);
  constant(device, device_interface, "Alias", known_ ? name_ : address_);
  if (known_)
    constant(device, device_interface, "Name", name_);
  if (heard_)
    constant(device, device_interface, "RSSI", computer_.strength(*this));
  device.registerProperty("Connected").onInterface(device_interface).withGetter([this] {
    return connected_;
  });
  device.registerProperty("ServicesResolved").onInterface(device_interface).withGetter([this] {
    return resolved_;
  });
  device.finishRegistration();
}

bool Robot::publishes(const spec::BleCharacteristicInfo& row) const {
  const bool greets = row.characteristic != BleCharacteristic::AntiDosV2 || !spec::is_open(model_);
  return spec::protocol_of(row.characteristic) == protocol_ && greets;
}

/// The services stay published after a disconnect, as in BlueZ.
void Robot::publish_services() {
  if (!services_.empty())
    return;
  for (const auto& row : spec::ble_services) {
    if (row.protocol != protocol_)
      continue;
    auto object = sdbus::createObject(
        computer_.connection(),
        fmt::format("{}/service{:04x}", path_, static_cast<std::size_t>(row.service)));
    constant(*object, service_interface, "UUID", std::string(row.uuid));
    constant(*object, service_interface, "Device", sdbus::ObjectPath(path_));
    constant(*object, service_interface, "Primary", true);
    object->finishRegistration();
    object->emitInterfacesAddedSignal();
    services_.push_back(std::move(object));
  }
  for (std::size_t number = 0; number < spec::ble_characteristics.size(); ++number)
    if (publishes(spec::ble_characteristics[number]))
      publish_characteristic(spec::ble_characteristics[number], number);
}

void Robot::publish_characteristic(const spec::BleCharacteristicInfo& row, std::size_t number) {
  const auto service =
      fmt::format("{}/service{:04x}", path_, static_cast<std::size_t>(row.service));
  // Client libraries parse the handle from the path.
  constexpr std::size_t first_handle = 16;
  auto object = sdbus::createObject(computer_.connection(),
                                    fmt::format("{}/char{:04x}", service, first_handle + number));
  const auto which = row.characteristic;
  const auto notifies = which == spec::sends_packets(protocol_);
  const auto takes = which != BleCharacteristic::Answers;
  constant(*object, characteristic_interface, "UUID", std::string(row.uuid));
  constant(*object, characteristic_interface, "Service", sdbus::ObjectPath(service));
  constant(*object, characteristic_interface, "Flags",
           !notifies ? std::vector<std::string>{"write", "write-without-response"}
           : takes   ? std::vector<std::string>{"notify", "write", "write-without-response"}
                     : std::vector<std::string>{"notify"});
  object->registerProperty("Notifying")
      .onInterface(characteristic_interface)
      .withGetter([this, which] { return !characteristics_[which].notified.empty(); });
  constant(*object, characteristic_interface, "NotifyAcquired", notifies && computer_.plan().held);
  object->registerMethod("WriteValue")
      .onInterface(characteristic_interface)
      .implementedAs([this, which](Result&& result, const Bytes& value, const Properties&) {
        on_write(which, value, std::move(result));
      });
  object->registerMethod("StartNotify")
      .onInterface(characteristic_interface)
      .implementedAs([this, which](Result&& result) { start_notify(which, std::move(result)); });
  object->registerMethod("StopNotify")
      .onInterface(characteristic_interface)
      .implementedAs([this, which] { stop_notify(which); });
  object->finishRegistration();
  object->emitInterfacesAddedSignal();
  characteristics_[which].object = std::move(object);
}

void Robot::unpublish() {
  disconnect();
  for (auto& [which, characteristic] : characteristics_)
    if (characteristic.object)
      characteristic.object->emitInterfacesRemovedSignal();
  characteristics_.clear();
  for (const auto& service : services_)
    service->emitInterfacesRemovedSignal();
  services_.clear();
  if (device_)
    device_->emitInterfacesRemovedSignal();
  device_.reset();
}

// Its link.

bool Robot::strikes(BleStep step) {
  const auto& plan = computer_.plan();
  const auto once = drop_once_ == step;
  if (once)
    drop_once_.reset();
  if (plan.vanish == step)
    computer_.vanish();
  else if (once || plan.drop == step)
    disconnect(); // the ball notices at its own end
  else
    return false;
  return true;
}

bool Robot::strikes(BleStep step, Result& result) {
  const auto& plan = computer_.plan();
  if (plan.vanish != step && plan.drop != step && drop_once_ != step)
    return false;
  // Deferred: the object called must not be destroyed during its own call.
  keep(std::move(result), {}, [this, step](Result& kept) {
    static_cast<void>(strikes(step));
    kept.returnError(bluez_error("Failed", "le-connection-abort-by-local"));
  });
  return true;
}

bool Robot::balks(BleStep step) {
  const auto once = balk_once_ == step;
  if (once)
    balk_once_.reset();
  return once || computer_.plan().balk == step;
}

void Robot::keep(Result&& result, Duration time, std::function<void(Result&)> answer) {
  kept_.emplace(++calls_, std::move(result));
  computer_.after(time, [this, number = calls_, answer = std::move(answer)] {
    answer(kept_.extract(number).mapped());
  });
}

void Robot::connect(Result&& result) {
  if (strikes(BleStep::Connect, result))
    return;
  if (connected_)
    return result.returnResults();
  if (balks(BleStep::Connect) || !computer_.has_link())
    return result.returnError(bluez_error("Failed", "le-connection-abort-by-local"));
  std::array<int, 2> ends{};
  if (!door_->admits() ||
      ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
    return result.returnError(bluez_error("Failed", "br-connection-busy"));
  stream_.assign(ends[0]);
  peer_.assign(ends[1]);
  connected_ = true;
  greeted_ = false;
  ++session_;
  tell(*device_, device_interface, {{"Connected", true}}); // before the answer, as BlueZ does
  result.returnResults();
  door_->enter(*this);
  await_packets();
  if (const auto patience = spec::patience(model_))
    computer_.after(*patience, [this, session = session_] {
      if (session == session_ && connected_ && !greeted_)
        disconnect();
    });
  computer_.after(computer_.plan().late, [this, session = session_] {
    if (session == session_ && connected_ && !strikes(BleStep::Services) &&
        !balks(BleStep::Services))
      resolve();
  });
}

void Robot::resolve() {
  publish_services();
  resolved_ = true;
  tell(*device_, device_interface, {{"ServicesResolved", true}});
}

void Robot::disconnect() {
  if (!connected_)
    return;
  connected_ = resolved_ = false;
  ++session_;
  peer_.close();
  for (auto& [which, characteristic] : characteristics_)
    if (!characteristic.notified.empty())
      set_notified(which, {});
  tell(*device_, device_interface, {{"ServicesResolved", false}, {"Connected", false}});
}

/// bluetoothd keeps the link of a client that has ended, but stops its notifications.
void Robot::forget(const std::string& client) {
  for (auto& [which, characteristic] : characteristics_)
    if (characteristic.notified == client)
      set_notified(which, {});
}

void Robot::set_notified(BleCharacteristic characteristic, const std::string& client) {
  auto& entry = characteristics_[characteristic];
  entry.notified = client;
  tell(*entry.object, characteristic_interface, {{"Notifying", !client.empty()}});
}

void Robot::on_write(BleCharacteristic characteristic, const Bytes& value, Result&& result) {
  if (!connected_)
    return result.returnError(not_connected());
  if (const auto step = protocol::step_of(characteristic); step && strikes(*step, result))
    return;
  if (const auto step = protocol::step_of(characteristic); step && balks(*step))
    return result.returnError(bluez_error("Failed", "Operation failed with ATT error: 0x0e"));
  if (characteristic == BleCharacteristic::Answers)
    return result.returnError(bluez_error("NotPermitted", "Write not permitted"));
  if (value.size() > spec::ble_piece_bytes) // robots do not support long writes
    return result.returnError(bluez_error("Failed", "Operation failed with ATT error: 0x06"));
  if (characteristic == spec::takes_packets(protocol_) && random_.chance(computer_.plan().refuse)) {
    if (random_.chance(half))
      take(characteristic, value);
    return result.returnError(bluez_error("Failed", "Operation failed with ATT error: 0x0e"));
  }
  if (computer_.plan().interval == Duration{}) {
    result.returnResults();
    return take(characteristic, value);
  }
  keep(std::move(result), computer_.plan().interval,
       [this, characteristic, value, session = session_](Result& kept) {
         if (session != session_)
           return kept.returnError(not_connected());
         kept.returnResults();
         take(characteristic, value);
       });
}

/// Handles a write, after its acknowledgement has left.
void Robot::take(BleCharacteristic characteristic, const Bytes& value) {
  for (const auto& row : spec::ble_greeting)
    if (row.characteristic == characteristic &&
        protocol::step_of(characteristic) == BleStep::AntiDos)
      greeted_ = as_text(value) == row.bytes;
  const bool hears = greeted_ || !spec::is_deaf(model_); // a deaf one answers nothing
  if (characteristic == spec::takes_packets(protocol_) && hears && !computer_.plan().mute)
    static_cast<void>(::write(peer_.native_handle(), value.data(), value.size()));
}

void Robot::start_notify(BleCharacteristic characteristic, Result&& result) {
  const auto& entry = characteristics_[characteristic];
  const auto client = entry.object->getCurrentlyProcessedMessage()->getSender();
  if (strikes(BleStep::Subscribe, result))
    return;
  if (computer_.plan().held)
    return result.returnError(bluez_error("NotPermitted", "Notify acquired"));
  if (balks(BleStep::Subscribe))
    return result.returnError(bluez_error("Failed", "Operation failed with ATT error: 0x0e"));
  if (characteristic != spec::sends_packets(protocol_))
    return result.returnError(bluez_error("NotSupported", "Operation is not supported"));
  result.returnResults();
  if (connected_) // otherwise the call succeeds, but no notifications follow
    set_notified(characteristic, client);
}

void Robot::stop_notify(BleCharacteristic characteristic) {
  if (characteristics_[characteristic].notified.empty())
    throw bluez_error("Failed", "No notify session started");
  set_notified(characteristic, {});
}

void Robot::await_packets() {
  peer_.async_read_some(asio::buffer(buffer_),
                        [this, session = session_](asio::error_code error, std::size_t size) {
                          if (session != session_)
                            return;
                          if (error)
                            return disconnect(); // the ball has hung up
                          notify(ByteView(buffer_).first(size));
                          await_packets();
                        });
}

void Robot::notify(ByteView bytes) {
  auto& answers = characteristics_[spec::sends_packets(protocol_)];
  const auto& plan = computer_.plan();
  while (!bytes.empty()) {
    const auto most = plan.pieces_least + random_.below(plan.pieces_most - plan.pieces_least + 1);
    const auto piece = bytes.first(std::min(bytes.size(), most));
    if (!answers.notified.empty() && !random_.chance(plan.lose))
      tell(*answers.object, characteristic_interface,
           {{"Value", Bytes(piece.begin(), piece.end())}});
    bytes = bytes.subspan(piece.size());
  }
}

std::unique_ptr<Link> Computer::make_robot(std::string name, std::string address,
                                           spec::BleModel model) {
  return std::make_unique<Robot>(*this, std::move(name), address, model);
}

} // namespace

tl::expected<std::unique_ptr<FakeBluez>, IoError>
make_fake_bluez(asio::io_context& io, const protocol::BleFaultPlan& plan) {
  return std::make_unique<Computer>(io, plan);
}

} // namespace orb::serve

#else

namespace orb::serve {

tl::expected<std::unique_ptr<FakeBluez>, IoError> make_fake_bluez(asio::io_context&,
                                                                  const protocol::BleFaultPlan&) {
  return tl::unexpected(IoError{"this orb was built without Bluetooth LE; install "
                                "`libsdbus-c++-dev` and build orb again"});
}

} // namespace orb::serve

#endif
