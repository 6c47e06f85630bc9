#pragma once

#include "base/io_error.h"
#include "protocol/ble_faults.h"
#include "serve/link.h"

#include <memory>
#include <string>
#include <tl/expected.hpp>

namespace orb::serve {

/// The Bluetooth of a Linux computer, as D-Bus shows it, with robots near it: `org.bluez` on a bus
/// of its own. Source: the documents in doc/ of BlueZ 5.66.
class FakeBluez {
public:
  /// What is wrong with it says `plan`, which must outlive it.
  FakeBluez(asio::io_context& io, const protocol::BleFaultPlan& plan);
  FakeBluez(const FakeBluez&) = delete;
  FakeBluez& operator=(const FakeBluez&) = delete;
  ~FakeBluez();

  tl::expected<void, IoError> open();

  /// The bus: what DBUS_SYSTEM_BUS_ADDRESS has to be for programs that shall find it.
  std::string bus() const;

  /// A robot near it that advertises `name`; the link must not outlive this.
  std::unique_ptr<Link> make_robot(std::string name, std::string address);

private:
  class Computer;
  class Robot;

  std::unique_ptr<Computer> computer_;
};

} // namespace orb::serve
