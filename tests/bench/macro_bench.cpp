// Measures assembling, disassembling, linting and running macros.

#include "assembler/assemble.h"
#include "assembler/disassemble.h"
#include "assembler/lint/lint.h"
#include "vm/macros/macro_executive.h"

#include <benchmark/benchmark.h>

namespace {

using namespace orb;

/// Returns a stream macro of ordinary commands, about `size` bytes of source.
Source source_of(std::size_t size) {
  std::string text = ".macro bench id=254 flags=motor_control\n.const pace = 100ms\n";
  while (text.size() < size)
    text += "roll speed=128 heading=90deg delay=200ms\n"
            "rgb 255, 0, 128, delay=pace\n"
            "delay 500\n"
            "fade red=0 green=64 blue=255 time=2s   # slowly\n"
            "raw_motors forward, 100, reverse, 100, 50ms\n"
            "marker 20\n";
  return {"bench.macro", text};
}

void assemble(benchmark::State& state) {
  const auto source = source_of(60'000);
  for (auto _ : state)
    benchmark::DoNotOptimize(assembler::assemble(source));
  state.SetBytesProcessed(static_cast<std::int64_t>(source.text().size()) * state.iterations());
}
BENCHMARK(assemble);

void check(benchmark::State& state) {
  const auto source = source_of(60'000);
  for (auto _ : state)
    benchmark::DoNotOptimize(assembler::check(source));
  state.SetBytesProcessed(static_cast<std::int64_t>(source.text().size()) * state.iterations());
}
BENCHMARK(check);

void disassemble(benchmark::State& state) {
  const auto body = assembler::assemble(source_of(60'000)).macros[0].body;
  for (auto _ : state)
    benchmark::DoNotOptimize(assembler::disassemble(body, assembler::Reading::Headerless));
  state.SetBytesProcessed(static_cast<std::int64_t>(body.size()) * state.iterations());
}
BENCHMARK(disassemble);

/// Ignores all requests.
class Idle : public vm::MacroHost {
public:
  std::uint64_t commands = 0;

  void drive(const vm::Motion&) override {}
  void set_led(vm::Color) override {}
  void set_back_led(int) override {}
  void configure_collisions(const vm::CollisionSettings&) override {}
  void emit_marker(int, int, int) override {}
  void trace_command(int, int) override { ++commands; }
  void sleep_ms(int) override {}
  bool stopped() const override { return true; }
  bool connected() const override { return false; }
};

/// Returns a macro that loops forever: rolls, colours, markers and a delay of `delay` ms.
void execute(benchmark::State& state) {
  const auto source =
      Source("bench.macro", ".macro bench id=40\nloop_start 255\nrgb 1, 2, 3\nroll 128, 90\n"
                            "marker 20\nset_sd1 5\ndelay " +
                                std::to_string(state.range(0)) + "\nloop_end\ngoto 40\n");
  const auto image = protocol::encode(assembler::assemble(source).macros[0].image());
  Idle idle;
  vm::MacroExecutive executive(idle);
  executive.save(image, Instant{});
  executive.start(40, Instant{});
  Instant now{};
  for (auto _ : state) {
    now += 1s;
    executive.advance_to(now);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(idle.commands));
}
BENCHMARK(execute)->Arg(0)->Arg(1)->Arg(100);

} // namespace
