// Compares parse and lint of realistic programs with LuaJIT's load() of equivalent Lua chunks of
// the same size. Both read from memory and discard the result.

#include "compiler/lint/lint.h"
#include "compiler/text/parse_basic.h"
#include "tests/bench/realistic.h"

#include <benchmark/benchmark.h>
#include <lua.hpp>
#include <string>

namespace {

using orb::bench::basic_program;
using orb::bench::lua_chunk;

void finish(benchmark::State& state, const std::string& text) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(text.size()));
  state.counters["bytes"] = static_cast<double>(text.size());
}

void parse(benchmark::State& state) {
  const auto text = basic_program(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(orb::compiler::parse(text));
  finish(state, text);
}

void parse_and_lint(benchmark::State& state) {
  const auto text = basic_program(static_cast<std::size_t>(state.range(0)));
  orb::compiler::Target target;
  target.ram_bytes = 4096;
  for (auto _ : state) {
    const auto program = orb::compiler::parse(text);
    const auto findings = orb::compiler::lint(program, target);
    if (!findings.empty())
      state.SkipWithError("the program is meant to be fine");
    benchmark::DoNotOptimize(findings.data());
  }
  finish(state, text);
}

void luajit_load(benchmark::State& state) {
  const auto text = lua_chunk(static_cast<std::size_t>(state.range(0)));
  lua_State* lua = luaL_newstate();
  for (auto _ : state) {
    if (luaL_loadbuffer(lua, text.data(), text.size(), "chunk") != 0)
      state.SkipWithError("the chunk is meant to be fine");
    lua_pop(lua, 1);
  }
  finish(state, text);
  lua_close(lua);
}

BENCHMARK(parse)->Arg(1024)->Arg(2048)->Arg(3600);
BENCHMARK(parse_and_lint)->Arg(1024)->Arg(2048)->Arg(3600);
BENCHMARK(luajit_load)->Arg(1024)->Arg(2048)->Arg(3600);

} // namespace
