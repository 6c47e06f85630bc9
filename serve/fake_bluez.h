#pragma once

#include "base/io_error.h"
#include "protocol/ble_faults.h"
#include "serve/link.h"
#include "spec/ble.h"

#include <asio/io_context.hpp>
#include <memory>
#include <string>
#include <tl/expected.hpp>

namespace orb::serve {

/// The Bluetooth of a Linux computer, as D-Bus shows it, with robots near it: `org.bluez` on a bus
/// of its own. Source: the documents in doc/ of BlueZ 5.66.
class FakeBluez {
public:
  virtual ~FakeBluez() = default;

  virtual tl::expected<void, IoError> open() = 0;

  /// A robot near it that advertises `name`; the link must not outlive this.
  virtual std::unique_ptr<Link> make_robot(std::string name, std::string address,
                                           spec::BleModel model) = 0;
};

/// What is wrong with it says `plan`, which must outlive it. An error where this program has no
/// Bluetooth LE.
tl::expected<std::unique_ptr<FakeBluez>, IoError>
make_fake_bluez(asio::io_context& io, const protocol::BleFaultPlan& plan);

} // namespace orb::serve
