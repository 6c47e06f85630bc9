#pragma once

#include "base/random.h"
#include "protocol/ble_faults.h"
#include "uploader/gatt.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace orb::test {

/// A robot's GATT on top of any transport, with the faults of Bluetooth LE: it replaces BlueZ and
/// D-Bus, and runs in the time of the transport.
class GattBall final : public uploader::Gatt {
public:
  /// `interval` is the time from a piece to its acknowledgement.
  GattBall(std::unique_ptr<protocol::Transport> ball, const protocol::BleFaultPlan& plan,
           Duration interval)
      : ball_(std::move(ball)), plan_(plan), interval_(interval), random_{plan.seed} {}

  Instant now() const override { return ball_->now(); }

  tl::expected<std::string, uploader::BleError> go(protocol::BleStep step,
                                                   const uploader::Patience& patience) override {
    ++steps_taken;
    if (step == protocol::BleStep::Connect)
      stale_ = std::exchange(connected_, true);
    if (strikes(step))
      return tl::unexpected(lost());
    // A refusal comes at once: patience would not help.
    if (balks(step) || (stale_ && step == protocol::BleStep::Services))
      return tl::unexpected(refused());
    if (step == protocol::BleStep::Services && now() + plan_.late > patience.deadline) {
      pass(patience.deadline - now());
      return tl::unexpected(
          uploader::BleError{uploader::BleFailure::NotResolved, "its services are not known"});
    }
    pass(step == protocol::BleStep::Services ? plan_.late : interval_);
    return std::string(protocol::info(step).word);
  }

  bool has(spec::BleCharacteristic characteristic) const override {
    return spec::protocol_of(characteristic) ==
           (plan_.newer ? spec::BleProtocol::V2 : spec::BleProtocol::V1);
  }

  bool held(spec::BleCharacteristic) const override {
    return false; // the failure shows at the subscription
  }

  std::string address() const override { return "68:86:E7:00:00:01"; }

  std::string name() const override { return advertised; }

  void let_go() override { connected_ = false; }

  tl::expected<void, uploader::BleError> write(spec::BleCharacteristic characteristic,
                                               ByteView bytes, const uploader::Patience&) override {
    longest_piece = std::max(longest_piece, bytes.size());
    const auto step = protocol::step_of(characteristic);
    if (step && strikes(*step))
      return tl::unexpected(lost());
    if (step && balks(*step))
      return tl::unexpected(refused());
    for (const auto& row : spec::ble_greeting)
      if (row.characteristic == characteristic)
        greeting += std::string(row.bytes) + "|";
    pass(interval_);
    if (characteristic != spec::BleCharacteristic::Commands)
      return {};
    const auto refused = random_.chance(plan_.refuse);
    constexpr double half = 0.5;
    if (!refused || random_.chance(half))
      if (!ball_->write(bytes))
        connected_ = false;
    if (!connected_)
      return tl::unexpected(lost());
    if (refused)
      return tl::unexpected(
          uploader::BleError{uploader::BleFailure::Refused, "no receipt for a piece"});
    return {};
  }

  tl::expected<void, uploader::BleError> subscribe(spec::BleCharacteristic,
                                                   const uploader::Patience&) override {
    if (strikes(protocol::BleStep::Subscribe))
      return tl::unexpected(lost());
    if (balks(protocol::BleStep::Subscribe))
      return tl::unexpected(refused());
    if (plan_.held)
      return tl::unexpected(uploader::BleError{uploader::BleFailure::Held, "held"});
    subscribed_ = true;
    return {};
  }

  void rest(const uploader::Patience& patience) override { pass(patience.deadline - now()); }

  /// Returns one piece, as one notification.
  tl::expected<Bytes, uploader::BleError> read(Instant deadline) override {
    while (pieces_.empty()) {
      if (!connected_)
        return tl::unexpected(lost());
      auto read = ball_->read(deadline);
      if (!read) {
        connected_ = false;
        return tl::unexpected(lost());
      }
      if (read->empty())
        return Bytes{};
      cut(*read);
    }
    return std::exchange(pieces_, {});
  }

  std::size_t longest_piece = 0;
  std::string advertised = "SK-0001";
  std::string greeting; ///< the written passwords, each followed by |
  int steps_taken = 0;

private:
  static uploader::BleError lost() { return {uploader::BleFailure::Lost, "the link was lost"}; }

  static uploader::BleError refused() {
    return {uploader::BleFailure::Refused, "the robot does not want to"};
  }

  bool balks(protocol::BleStep step) {
    const auto once = plan_.balk_once == step;
    if (once)
      plan_.balk_once.reset();
    return once || plan_.balk == step;
  }

  bool strikes(protocol::BleStep step) {
    const auto once = plan_.drop_once == step;
    if (once)
      plan_.drop_once.reset();
    if (once || plan_.drop == step)
      connected_ = false;
    return once || plan_.drop == step;
  }

  /// Advances the time; output of the ball is queued.
  void pass(Duration time) {
    const auto until = now() + time;
    while (now() < until) {
      auto read = ball_->read(until);
      if (!read) {
        connected_ = false;
        return;
      }
      cut(*read);
    }
  }

  void cut(ByteView bytes) {
    while (!bytes.empty()) {
      const auto size =
          plan_.pieces_least + random_.below(plan_.pieces_most - plan_.pieces_least + 1);
      const auto piece = bytes.first(std::min(bytes.size(), size));
      if (subscribed_ && !random_.chance(plan_.lose))
        pieces_.insert(pieces_.end(), piece.begin(), piece.end());
      bytes = bytes.subspan(piece.size());
    }
  }

  std::unique_ptr<protocol::Transport> ball_;
  protocol::BleFaultPlan plan_;
  Duration interval_;
  Random random_;
  Bytes pieces_;
  bool connected_ = false;
  bool stale_ = false; ///< the link belongs to an earlier attempt
  bool subscribed_ = false;
};

} // namespace orb::test
