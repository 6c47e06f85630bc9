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

/// The Bluetooth of a Linux computer with robots nearby, as seen over D-Bus: `org.bluez` on a
/// private bus. Source: the documents in doc/ of BlueZ 5.66.
class FakeBluez {
public:
  virtual ~FakeBluez() = default;

  virtual tl::expected<void, IoError> open() = 0;

  /// Creates a robot nearby that advertises `name`. The link must not outlive this object.
  virtual std::unique_ptr<Link> make_robot(std::string name, std::string address,
                                           spec::BleModel model) = 0;
};

/// `plan` contains the faults and must outlive it. Fails if this build has no Bluetooth LE.
tl::expected<std::unique_ptr<FakeBluez>, IoError>
make_fake_bluez(asio::io_context& io, const protocol::BleFaultPlan& plan);

} // namespace orb::serve
