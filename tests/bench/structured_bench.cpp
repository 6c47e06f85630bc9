// Measures compiling structured programs: from the text to the checked image, and for comparison
// reading and checking alone. The generated program resembles the examples (subs, loops, choices),
// without comments. At the root of the repository the examples are compiled, too.

#include "structured/compile.h"
#include "structured/meaning/check.h"
#include "structured/text/read.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using namespace orb::structured;

/// Returns a program of about `lines` lines; 200 of them fill an area.
std::string program(std::int64_t lines) {
  std::string text = "' a patrol\nconst side = 400ms\narray visits[12]\ncourse = 0\n\n";
  std::string subs;
  for (std::int64_t n = 0; 16 * n < lines; ++n) {
    text += fmt::format("for round_{0} = 1 to {1}\n  leg_{0}(round_{0} * 30)\n"
                        "  if speed <= 5 and course > 90 then print \"stuck at \", course\n"
                        "next round_{0}\n",
                        n, n % 5 + 2);
    subs += fmt::format("\nsub leg_{0}(turn)\n  local n ' of this leg\n"
                        "  course = (course + turn) % 360\n  RGB course % 256, {1}, 0\n"
                        "  goroll course, {2}, 1\n  delay side\n  visits[{3}] += 1\n"
                        "  n = visits[{3}] * 2\n  print \"visited {0}: \", n\nend sub\n",
                        n, n * 7 % 256, 60 + n % 90, n % 12 + 1);
  }
  return text + "goroll 0, 0, 0\n" + subs;
}

void finish(benchmark::State& state, const std::string& text) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(text.size()));
  state.counters["bytes"] = static_cast<double>(text.size());
}

void compile_program(benchmark::State& state) {
  const auto text = program(state.range(0));
  orb::compiler::Target target;
  target.ram_bytes = 4096;
  NoFiles files;
  for (auto _ : state) {
    const auto compiled = compile("a.orb", "a.orb", text, target, files);
    if (compiled.has_errors())
      state.SkipWithError("the program is meant to be fine");
    benchmark::DoNotOptimize(compiled.robot.text.data());
  }
  finish(state, text);
}

/// Returns the structured programs below a folder, by name.
std::vector<std::string> programs_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".orb" && entry.path().stem() != "mistakes")
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> programs;
  for (const auto& path : paths) {
    std::ifstream file(path);
    programs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return programs;
}

void compile_examples(benchmark::State& state) {
  const auto programs = programs_of("examples");
  if (programs.empty())
    return state.SkipWithError("start it where examples/ is");
  std::string all;
  for (const auto& text : programs)
    all += text;
  orb::compiler::Target target;
  target.ram_bytes = 4096;
  NoFiles files;
  for (auto _ : state)
    for (const auto& text : programs) {
      const auto compiled = compile("a.orb", "a.orb", text, target, files);
      if (compiled.has_errors())
        state.SkipWithError("the examples are meant to be fine");
      benchmark::DoNotOptimize(compiled.robot.text.data());
    }
  finish(state, all);
}

void read_and_check(benchmark::State& state) {
  const auto text = program(state.range(0));
  NoFiles files;
  for (auto _ : state) {
    auto read_program = read("a.orb", "a.orb", text, files);
    const auto names = resolve(read_program);
    check(read_program, names, {});
    benchmark::DoNotOptimize(read_program.statements.data());
  }
  finish(state, text);
}

BENCHMARK(compile_program)->Arg(50)->Arg(100)->Arg(200);
BENCHMARK(compile_examples);
BENCHMARK(read_and_check)->Arg(50)->Arg(100)->Arg(200);

} // namespace
