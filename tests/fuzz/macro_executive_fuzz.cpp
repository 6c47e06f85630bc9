// Runs any bytes as user, temporary and stream macros. They must end in time or by an abort.

#include "vm/macros/macro_executive.h"

namespace {

using namespace orb;

class Anything : public vm::MacroHost {
public:
  void drive(const vm::Motion&) override {}
  void set_led(vm::Color) override {}
  void set_back_led(int) override {}
  void configure_collisions(const vm::CollisionSettings&) override {}
  void emit_marker(int, int, int) override {}
  void trace_command(int, int) override {}
  void sleep_ms(int) override {}
  bool stopped() const override { return false; }
  bool connected() const override { return false; }
};

} // namespace

// The first byte of each piece selects what happens with the following bytes, so that the fuzzer
// can play a whole session: save, run, stream, collide, abort.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Anything host;
  vm::MacroExecutive executive(host);
  Instant now{};
  for (ByteView rest(data, size); rest.size() >= 2;) {
    const auto what = rest[0];
    const auto length = std::min<std::size_t>(rest[1], rest.size() - 2);
    const auto piece = rest.subspan(2, length);
    rest = rest.subspan(2 + length);
    switch (what % 8) {
    case 0: executive.save(piece, now); break;
    case 1: executive.save_temporary(piece, now); break;
    case 2: executive.append_chunk(piece, now); break;
    case 3: executive.start(piece.empty() ? 255 : piece[0], now); break;
    case 4: executive.collide(now); break;
    case 5: executive.abort(now); break;
    case 6:
      if (piece.size() >= 3)
        executive.set_parameter(piece[0], piece[1], piece[2]);
      break;
    case 7: executive.fall_asleep(now); break;
    }
    now += 20ms;
    executive.advance_to(now);
  }
  return 0;
}
