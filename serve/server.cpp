#include "serve/server.h"

#include "serve/served_ball.h"

#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>
#include <memory>

namespace orb::serve {

tl::expected<void, IoError> serve(const ServeOptions& options) {
  asio::io_context io{1};
  asio::signal_set signals(io, SIGINT, SIGTERM);
  signals.async_wait([&io](asio::error_code, int) { io.stop(); });

  std::unique_ptr<FakeBluez> bluez;
  if (options.bluez) {
    auto made = make_fake_bluez(io, *options.bluez);
    if (!made)
      return tl::unexpected(made.error());
    bluez = *std::move(made);
    if (auto opened = bluez->open(); !opened)
      return opened;
  }
  std::vector<std::unique_ptr<ServedBall>> balls;
  std::string addresses;
  for (int i = 0; i < options.count; ++i) {
    balls.push_back(std::make_unique<ServedBall>(io, options, i, bluez.get()));
    if (auto opened = balls.back()->open(); !opened)
      return opened;
    addresses += balls.back()->addresses();
  }
  options.announce(addresses);
  const auto start = ServedBall::Clock::now();
  for (const auto& ball : balls)
    ball->start(start);
  io.run();

  std::optional<IoError> error;
  for (const auto& ball : balls) {
    if (auto saved = ball->save(); !saved)
      error = saved.error();
    else if (ball->error())
      error = ball->error();
  }
  if (error)
    return tl::unexpected(*error);
  return {};
}

} // namespace orb::serve
