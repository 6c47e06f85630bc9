#pragma once

#include "uploader/gatt.h"

#include <utility>

namespace orb::uploader {

/// Stands in for a robot in a build without Bluetooth LE: every step fails with the reason.
class NoGatt final : public Gatt {
public:
  explicit NoGatt(BleError why) : why_(std::move(why)) {}

  Instant now() const override { return {}; }
  tl::expected<std::string, BleError> go(protocol::BleStep, const Patience&) override {
    return tl::unexpected(why_);
  }
  bool has(spec::BleCharacteristic) const override { return false; }
  bool held(spec::BleCharacteristic) const override { return false; }
  std::string address() const override { return {}; }
  std::string name() const override { return {}; }
  void let_go() override {}
  tl::expected<void, BleError> write(spec::BleCharacteristic, ByteView, const Patience&) override {
    return tl::unexpected(why_);
  }
  tl::expected<void, BleError> subscribe(spec::BleCharacteristic, const Patience&) override {
    return tl::unexpected(why_);
  }
  void rest(const Patience&) override {}
  tl::expected<Bytes, BleError> read(Instant) override { return tl::unexpected(why_); }

private:
  BleError why_;
};

} // namespace orb::uploader
