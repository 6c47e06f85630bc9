// Compiles, checks and briefly runs any text that a ball can store. Both engines must print the
// same.

#include "bytecode/chunk.h"
#include "compiler/load.h"
#include "vm/ball.h"

#include <cstdlib>

namespace {

using namespace orb;

class Printed final : public vm::Observer {
public:
  void on_event(Instant, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      text += print->text;
  }
  std::string text;
};

std::string run(ByteView program, vm::Dispatch dispatch) {
  Printed printed;
  vm::BallOptions options;
  options.loader = compiler::load;
  options.observer = &printed;
  options.dispatch = dispatch;
  vm::Ball ball(options);
  ball.connect();
  ball.append_basic(vm::Area::Ram, program);
  const auto chunk = compiler::load(ball.basic_text(vm::Area::Ram));
  if (bytecode::verify(chunk))
    std::abort();
  ball.execute_basic(vm::Area::Ram, chunk.lines.empty() ? 10 : chunk.lines.front().number);
  ball.advance_to(ball.now() + 1s);
  return printed.text;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView program{data, std::min<std::size_t>(size, 4096)};
  if (run(program, vm::Dispatch::Threaded) != run(program, vm::Dispatch::Switch))
    std::abort();
  return 0;
}
