#include "serve/server.h"

#include "base/contain.h"
#include "serve/control.h"
#include "serve/line_reader.h"
#include "serve/served_ball.h"

#include <asio/io_context.hpp>
#include <asio/signal_set.hpp>
#include <csignal>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::serve {
namespace {

tl::unexpected<Failure> fail(const IoError& error) {
  return refuse(ExitCode::File, error.message);
}

/// Writes the answer of each ball addressed; with several balls it begins with their number.
void obey(const ServeOptions& options, std::vector<std::unique_ptr<ServedBall>>& balls,
          const std::string& line) {
  const auto control = parse_control(line, options.count);
  if (!control)
    return options.answer(fmt::format("error: {}\n", control.error()));
  if (!*control)
    return;
  for (int i = 0; i < options.count; ++i)
    if ((*control)->ball.value_or(i + 1) == i + 1) {
      const auto answer = balls[static_cast<std::size_t>(i)]->obey(**control);
      options.answer(options.count == 1 ? answer + "\n" : fmt::format("{} {}\n", i + 1, answer));
    }
}

} // namespace

tl::expected<void, Failure> serve(const ServeOptions& options) {
  asio::io_context io{1};
  asio::signal_set signals(io, SIGINT, SIGTERM);
  signals.async_wait([&io](asio::error_code, int) { io.stop(); });

  std::unique_ptr<FakeBluez> bluez;
  if (options.bluez) {
    auto made = make_fake_bluez(io, *options.bluez);
    if (!made)
      return fail(made.error());
    bluez = *std::move(made);
    if (auto opened = bluez->open(); !opened)
      return fail(opened.error());
  }
  std::vector<std::unique_ptr<ServedBall>> balls;
  std::string addresses;
  for (int i = 0; i < options.count; ++i) {
    balls.push_back(std::make_unique<ServedBall>(io, options, i, bluez.get()));
    if (auto opened = balls.back()->open(); !opened)
      return fail(opened.error());
    addresses += balls.back()->addresses();
  }
  options.announce(addresses);
  const auto start = ServedBall::Clock::now();
  for (const auto& ball : balls)
    ball->start(start);
  std::optional<LineReader> lines;
  if (options.control)
    lines.emplace(io, options.control,
                  [&](const std::string& line) { obey(options, balls, line); });
  const auto served = contain([&]() -> tl::expected<void, Failure> {
    io.run();
    return {};
  });

  std::optional<IoError> error;
  for (const auto& ball : balls) {
    ball->end();
    if (auto saved = ball->save(); !saved)
      error = saved.error();
    else if (ball->error())
      error = ball->error();
  }
  if (served && error)
    return fail(*error);
  return served;
}

} // namespace orb::serve
