// Reads any text as a stimulus script and plays what could be read.

#include "vm/ball.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const Source source("fuzz", std::string(as_text({data, size})));
  const auto script = vm::parse_stimulus(source);
  vm::Ball ball({});
  ball.schedule(script.events);
  ball.advance_to(ball.now() + 100ms);
  return 0;
}
