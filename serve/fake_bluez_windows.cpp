#include "serve/fake_bluez.h"

namespace orb::serve {

tl::expected<std::unique_ptr<FakeBluez>, IoError> make_fake_bluez(asio::io_context&,
                                                                  const protocol::BleFaultPlan&) {
  return tl::unexpected(
      IoError{"there is no simulated Bluetooth adapter on Windows; serve the ball "
              "with `--tcp 127.0.0.1:4242`"});
}

} // namespace orb::serve
