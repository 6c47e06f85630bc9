#include "uploader/ble.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::uploader {
namespace {

using protocol::BleStep;
using protocol::LinkError;
using spec::BleCharacteristic;

struct FailureInfo {
  BleFailure failure;
  std::string_view remedy;
  bool again; ///< a later attempt can help
};

// clang-format off
constexpr auto failures = std::to_array<FailureInfo>({
    {BleFailure::NotBuilt,     "install `libsdbus-c++-dev` and build orb again; `orb --version -v` says whether it has Bluetooth LE", false},
    {BleFailure::NoSystem,     "the playground reaches these robots, in Chrome or Edge", false},
    {BleFailure::NotLoaded,    "reinstall orb with all its files, and `libsdbus-c++1` (in a checkout: `./dev build`)", false},
    {BleFailure::NoBus,        "start it with `sudo systemctl start dbus`; in a container, mount /run/dbus/system_bus_socket", false},
    {BleFailure::NoDaemon,     "`sudo systemctl start bluetooth`; it is in the package `bluez`", false},
    {BleFailure::NotAllowed,   "`sudo usermod -aG bluetooth $USER`, then log in again", false},
    {BleFailure::NoAdapter,    "plug one in; `bluetoothctl list` shows them", false},
    {BleFailure::AdapterOff,   "`bluetoothctl power on`; if that fails, `rfkill unblock bluetooth`", false},
    {BleFailure::AdapterGone,  "plug it in again, or use another port if that one is loose", false},
    {BleFailure::NotFound,     "take it off the charger, shake it awake, bring it closer, and close any app that may be using it", false},
    {BleFailure::Ambiguous,    "name one by its address; `orb ports` lists them", false},
    {BleFailure::NotConnected, "shake the robot awake, bring it closer, and close any app or disconnect any phone that may be using it", true},
    {BleFailure::NotResolved,  "bring the robot closer and try again; `bluetoothctl remove ADDRESS` makes the computer discover it again", true},
    {BleFailure::Undriven,     "`orb ports` lists robots", false},
    {BleFailure::NoRobot,      "`orb ports` lists robots", false},
    {BleFailure::Refused,      "shake the robot and try again; `bluetoothctl remove ADDRESS` makes the computer discover it again", true},
    {BleFailure::Held,         "close that program, or disconnect the robot with `bluetoothctl disconnect ADDRESS`", false},
    {BleFailure::Lost,         "bring the robot closer, charge it, and try again", true},
    {BleFailure::Interrupted,  "", false},
});
// clang-format on

constexpr const FailureInfo& info(BleFailure failure) {
  return failures[static_cast<std::size_t>(failure)];
}

consteval bool failures_are_in_order() {
  for (std::size_t i = 0; i < failures.size(); ++i)
    if (failures[i].failure != static_cast<BleFailure>(i))
      return false;
  return true;
}
static_assert(failures_are_in_order());

/// Writes packets in pieces and reads notifications.
class BleTransport final : public protocol::Transport {
public:
  BleTransport(std::unique_ptr<Gatt> gatt, spec::BleProtocol protocol, const Budgets& budgets,
               StopRequests stop)
      : gatt_(std::move(gatt)), commands_(spec::takes_packets(protocol)), budgets_(budgets),
        stop_(std::move(stop)) {}

  Instant now() const override { return gatt_->now(); }

  tl::expected<void, LinkError> write(ByteView packet) override {
    const Patience patience{now() + budgets_.send,
                            [this, asked = stop_()] { return stop_() > asked ? 1 : 0; }};
    while (!packet.empty()) {
      const auto piece = packet.first(std::min(packet.size(), budgets_.piece));
      if (const auto written = gatt_->write(commands_, piece, patience); !written)
        return lose(written.error());
      packet = packet.subspan(piece.size());
    }
    return {};
  }

  tl::expected<Bytes, LinkError> read(Instant deadline) override {
    auto read = gatt_->read(deadline);
    if (!read)
      return link_error(read.error());
    return *std::move(read);
  }

private:
  tl::unexpected<LinkError> link_error(BleError error) const {
    error.address = gatt_->address();
    return tl::unexpected(
        LinkError{LinkError::Kind::Closed, fmt::format("{}; {}", error.seen, remedy(error))});
  }

  /// A piece without acknowledgement may have arrived, so it is never repeated: the packet is lost,
  /// or the link is.
  tl::expected<void, LinkError> lose(const BleError& error) const {
    if (error.failure == BleFailure::Refused)
      return {};
    if (error.failure == BleFailure::Interrupted)
      return tl::unexpected(LinkError{LinkError::Kind::Interrupted, "interrupted"});
    return link_error(error);
  }

  std::unique_ptr<Gatt> gatt_;
  BleCharacteristic commands_;
  Budgets budgets_;
  StopRequests stop_;
};

/// Takes the steps to one robot, each within its budget.
class Opening {
public:
  Opening(Gatt& gatt, const Budgets& budgets, const StopRequests& stop, const OnBleStep& on_step,
          const OnBlePeer& on_peer)
      : gatt_(gatt), budgets_(budgets), stop_(stop), on_step_(on_step), on_peer_(on_peer) {}

  tl::expected<void, BleError> run() {
    for (const auto step : {BleStep::Bus, BleStep::Adapter, BleStep::Find})
      if (auto done = take(step); !done)
        return give_up(done.error());
    if (auto why = undriven(gatt_.name()))
      return give_up({BleFailure::Undriven, *std::move(why)});
    for (int time = 1;; ++time) {
      auto done = connect();
      if (done) {
        if (on_peer_)
          on_peer_({gatt_.name(), protocol_});
        return {};
      }
      if (time >= budgets_.opens || !info(done.error().failure).again || stop_() > 0)
        return give_up(done.error());
      gatt_.let_go(); // a link that failed once will not recover
      gatt_.rest(patience(budgets_.backoff(time)));
    }
  }

  /// The robot's protocol, known after run().
  spec::BleProtocol protocol() const { return protocol_; }

private:
  Patience patience(Duration budget) const { return {gatt_.now() + budget, stop_}; }

  tl::expected<void, BleError> connect() {
    for (const auto step : {BleStep::Connect, BleStep::Services})
      if (auto done = take(step); !done)
        return done;
    if (auto known = check_characteristics(); !known)
      return known;
    // Check before writing: a write would disturb the other program's conversation.
    const auto answers = spec::sends_packets(protocol_);
    if (gatt_.held(answers))
      return tl::unexpected(BleError{BleFailure::Held, std::string(held_by_another)});
    for (const auto& row : spec::ble_greeting) {
      if (spec::protocol_of(row.characteristic) != protocol_ || !gatt_.has(row.characteristic))
        continue;
      step_ = *protocol::step_of(row.characteristic);
      if (auto written =
              gatt_.write(row.characteristic, as_bytes(row.bytes), patience(budgets_.ble_answer));
          !written)
        return written;
      tell(std::string(row.summary));
    }
    step_ = BleStep::Subscribe;
    if (auto subscribed = gatt_.subscribe(answers, patience(budgets_.ble_answer)); !subscribed)
      return subscribed;
    tell("subscribed to its answers");
    return {};
  }

  tl::expected<void, BleError> take(BleStep step) {
    step_ = step;
    auto found = gatt_.go(step, patience(budget(step)));
    if (!found)
      return tl::unexpected(found.error());
    tell(*std::move(found));
    return {};
  }

  Duration budget(BleStep step) const {
    switch (step) {
    case BleStep::Find: return budgets_.scan;
    case BleStep::Connect: return budgets_.ble_connect;
    case BleStep::Services: return budgets_.services;
    case BleStep::Bus:
    case BleStep::Adapter:
    case BleStep::AntiDos:
    case BleStep::TxPower:
    case BleStep::Wake:
    case BleStep::Subscribe: break;
    }
    return budgets_.ble_answer;
  }

  tl::expected<void, BleError> check_characteristics() {
    const bool is_v2 = gatt_.has(BleCharacteristic::PacketsV2);
    protocol_ = is_v2 ? spec::BleProtocol::V2 : spec::BleProtocol::V1;
    for (const auto& row : spec::ble_characteristics)
      if (!is_v2 && spec::protocol_of(row.characteristic) == spec::BleProtocol::V1 &&
          !gatt_.has(row.characteristic))
        return tl::unexpected(BleError{
            BleFailure::NoRobot,
            fmt::format("it is not a robot that orb knows: it lacks characteristic {}", row.uuid)});
    return {};
  }

  /// Reports each step once, even if it is repeated.
  void tell(std::string found) {
    if (!told_ || step_ > *told_) {
      told_ = step_;
      if (on_step_)
        on_step_(step_, std::move(found));
    }
  }

  tl::unexpected<BleError> give_up(BleError error) {
    error.address = gatt_.address();
    if (on_step_)
      on_step_(step_, tl::unexpected(error));
    return tl::unexpected(error);
  }

  Gatt& gatt_;
  const Budgets& budgets_;
  const StopRequests& stop_;
  const OnBleStep& on_step_;
  const OnBlePeer& on_peer_;
  spec::BleProtocol protocol_ = spec::BleProtocol::V1;
  BleStep step_{};
  std::optional<BleStep> told_;
};

} // namespace

std::optional<std::string> undriven(std::string_view name) {
  const auto* row = spec::find_ble_name(name);
  if (row == nullptr || row->protocol != spec::BleProtocol::None)
    return std::nullopt;
  return fmt::format("`{}` is a {}, which orb knows but cannot drive", name, row->robot);
}

std::string remedy(const BleError& error) {
  constexpr std::string_view placeholder = "ADDRESS";
  auto text = std::string(info(error.failure).remedy);
  if (const auto at = text.find(placeholder); at != text.npos && !error.address.empty())
    text.replace(at, placeholder.size(), error.address);
  return text;
}

tl::expected<std::unique_ptr<protocol::Transport>, BleError>
open_ble(std::unique_ptr<Gatt> gatt, const Budgets& budgets, const StopRequests& stop,
         const OnBleStep& on_step, const OnBlePeer& on_peer) {
  Opening opening(*gatt, budgets, stop, on_step, on_peer);
  if (const auto opened = opening.run(); !opened)
    return tl::unexpected(opened.error());
  return std::make_unique<BleTransport>(std::move(gatt), opening.protocol(), budgets, stop);
}

LinkError describe_open_error(const Endpoint& endpoint, const BleError& error) {
  if (error.failure == BleFailure::Interrupted)
    return {LinkError::Kind::Interrupted, error.seen};
  return {error.failure == BleFailure::Undriven ? LinkError::Kind::Unfit
                                                : LinkError::Kind::CannotOpen,
          fmt::format("cannot open {}: {}; {}", endpoint.text, error.seen, remedy(error))};
}

Budgets ble_budgets(Budgets budgets) {
  budgets.piece = spec::ble_piece_bytes;
  budgets.send = budgets.ble_send;
  return budgets;
}

} // namespace orb::uploader
