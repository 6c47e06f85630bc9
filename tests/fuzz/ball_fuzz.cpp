// Feeds the whole ball any bytes at any time. It must not crash, hang or grow, and must answer a
// ping once an incomplete packet has timed out.

#include "compiler/load.h"
#include "vm/ball.h"

#include <algorithm>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  vm::BallOptions options;
  options.loader = compiler::load;
  vm::Ball ball(options);
  ball.connect();
  std::size_t at = 0;
  // Chunks: a length, then a pause in units of 8 ms, then the bytes.
  while (at + 2 <= size) {
    const auto length = std::min<std::size_t>(data[at], size - at - 2);
    const auto pause = std::chrono::milliseconds{8 * data[at + 1]};
    ball.receive(ByteView(data + at + 2, length));
    ball.advance_to(ball.now() + pause);
    if (ball.take_output().size() > 1 << 20)
      std::abort();
    at += 2 + length;
  }
  ball.advance_to(ball.now() + std::chrono::milliseconds{501});
  if (!ball.connected())
    ball.connect(); // it fell asleep
  // Every ball answers a ping, even in the bootloader; programs may fill the wire for a while.
  ball.receive(encode(protocol::make_command(spec::ApiCommand::AbortOrbbasicProgram)));
  ball.receive(encode(protocol::make_command(spec::ApiCommand::AbortMacro)));
  ball.receive(encode(protocol::make_command(spec::ApiCommand::SetDataStreaming, Bytes(9))));
  ball.take_output();
  ball.receive(encode(protocol::make_command(spec::ApiCommand::Ping, {}, 0x5A)));
  ball.advance_to(ball.now() + std::chrono::seconds{2});
  const auto output = ball.take_output();
  protocol::Decoder decoder(protocol::Direction::FromBall);
  decoder.feed(output);
  while (const auto item = decoder.next())
    if (item->kind == protocol::Item::Kind::Response && item->seq == 0x5A && item->code == 0)
      return 0;
  std::abort();
}
