// Compares the machine with LuaJIT, interpreted and compiled, and gcc -O2 on the same algorithms:
// tests/bench/kernels/NAME.bas, .lua and .c. Prints the table of docs/inside/performance.md. Run it
// through ./dev bench.

#include "compiler/load.h"
#include "tests/bench/realistic.h"
#include "vm/ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <malloc.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace orb;
constexpr int rounds = 7; // the best of several runs, as disturbances only add time

/// Returns processor time in seconds, as luajit's os.clock() does: other programs do not count.
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double since(double start) {
  return processor_time() - start;
}

std::string read_all(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Records the prints of a program.
class Printed final : public vm::Observer {
public:
  void on_event(Instant, const vm::Event& event) override {
    if (const auto* print = std::get_if<vm::event::Print>(&event))
      text += print->text;
    if (const auto* error = std::get_if<vm::event::Error>(&event))
      throw std::runtime_error(fmt::format("line {} failed", error->line));
  }
  std::string text;
};

struct Measured {
  double seconds = 0;
  std::uint64_t lines = 0;
  std::string printed;
};

/// Runs a program on a whole ball, as `orb run` does, and times it from start to end.
Measured run_basic(const std::string& text, vm::Native native) {
  Printed printed;
  vm::BallOptions options;
  options.loader = compiler::load;
  options.observer = &printed;
  options.native = native;
  vm::Ball ball(options);
  ball.connect();
  ball.append_basic(vm::Area::Ram, as_bytes(text));
  const double start = processor_time();
  ball.execute_basic(vm::Area::Ram, 10);
  while (ball.basic_running())
    ball.advance_to(ball.now() + 1h);
  return {since(start), ball.machine().lines(), printed.text};
}

/// Runs a command that prints its result, then the seconds that it took.
Measured run_command(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe)
    throw std::runtime_error("cannot run " + command);
  std::string out;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()))
    out += buffer.data();
  const auto split = out.find('\n');
  if (split == std::string::npos)
    throw std::runtime_error(command + " said: " + out);
  return {std::strtod(out.c_str() + split, nullptr), 0, out.substr(0, split + 1)};
}

/// Runs a kernel in LuaJIT, or with `-joff` in its interpreter.
Measured run_lua(const std::string& option, const std::string& path) {
  return run_command(fmt::format("luajit {} -e \"local t = os.clock(); dofile('{}.lua'); "
                                 "print(string.format('%.9f', os.clock() - t))\"",
                                 option, path));
}

/// Compiles a kernel with gcc -O2 and returns the path of the program.
std::string build_c(const std::string& path, const std::string& option) {
  const auto program = (std::filesystem::temp_directory_path() / "orb-bench").string() + option;
  const auto timed = std::filesystem::path(path).replace_filename("timed.c").string();
  const auto command =
      fmt::format("gcc -O2 -fwrapv {} -o '{}' -include {}.c {}", option, program, path, timed);
  if (std::system(command.c_str()) != 0)
    throw std::runtime_error("cannot build: " + command);
  return program;
}

struct Kernel {
  const char* name;
  const char* what;
};

/// Times by contestant: the best of several rounds in which all take turns.
struct Times {
  double lua = 1e9;
  double lua_compiled = 1e9;
  double gcc = 1e9;
  double gcc_counting = 1e9;
  double loop = 1e9;
  double machine_code = 1e9;
  std::uint64_t lines = 0;
};

Times time(const std::string& folder, const Kernel& kernel) {
  const auto path = folder + "/" + kernel.name;
  const auto text = read_all(path + ".bas");
  const auto program = build_c(path, "");
  const auto counting = build_c(path, "-DCOUNTED");
  Times best;
  std::string printed;
  const auto note = [&](double& least, const Measured& measured) {
    if (!printed.empty() && measured.printed != printed)
      throw std::runtime_error(
          fmt::format("{}: one prints {}, another {}", kernel.name, printed, measured.printed));
    printed = measured.printed;
    least = std::min(least, measured.seconds);
  };
  for (int round = 0; round < rounds; ++round) {
    note(best.lua, run_lua("-joff", path));
    note(best.lua_compiled, run_lua("", path));
    note(best.gcc, run_command(program));
    note(best.gcc_counting, run_command(counting));
    note(best.loop, run_basic(text, vm::Native::Off));
    const auto last = run_basic(text, vm::Native::Auto);
    note(best.machine_code, last);
    best.lines = last.lines;
  }
  std::filesystem::remove(program);
  std::filesystem::remove(counting);
  return best;
}

void against_others(const std::string& folder) {
  constexpr std::array kernels{Kernel{"nested", "nested loops, arithmetic"},
                               Kernel{"collatz", "branches, division"},
                               Kernel{"calls", "subroutines"}, Kernel{"sort", "a sort through Z"}};
  fmt::print("{:<25}{:>8}{:>7}{:>7}{:>7}{:>9}{:>7}{:>7} |{:>7}{:>8}{:>8}{:>8}{:>9}\n", "", "lines",
             "-joff", "luajit", "gcc", "counting", "loop", "native", "loop", "native", "native",
             "native", "native");
  fmt::print("{:<77} |{:>7}{:>8}{:>8}{:>8}{:>9}\n", "milliseconds, ratios", "/-joff", "/-joff",
             "/luajit", "/gcc", "/counting");
  std::array<double, 5> product{1, 1, 1, 1, 1};
  for (const auto& kernel : kernels) {
    const auto t = time(folder, kernel);
    const std::array ratios{t.lua / t.loop, t.lua / t.machine_code, t.lua_compiled / t.machine_code,
                            t.gcc / t.machine_code, t.gcc_counting / t.machine_code};
    fmt::print("{:<25}{:>8}{:>7.1f}{:>7.2f}{:>7.2f}{:>9.2f}{:>7.2f}{:>7.2f} |", kernel.what,
               t.lines, t.lua * 1e3, t.lua_compiled * 1e3, t.gcc * 1e3, t.gcc_counting * 1e3,
               t.loop * 1e3, t.machine_code * 1e3);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      fmt::print("{:>{}.2f}x", ratios[i], i == 0 ? 6 : i == 4 ? 8 : 7);
      product[i] *= ratios[i];
    }
    fmt::print("\n");
  }
  fmt::print("{:<77} |", "geometric mean");
  for (std::size_t i = 0; i < product.size(); ++i)
    fmt::print("{:>{}.2f}x", std::pow(product[i], 1.0 / kernels.size()),
               i == 0   ? 6
               : i == 4 ? 8
                        : 7);
  fmt::print("\n\n");
}

void one_hour() {
  const std::string text = "10 A = A + 7\n"
                           "20 if A > 359 then A = A - 360\n"
                           "30 goroll A,120,1\n"
                           "40 RGB A * 255 / 359, 80, timerB & 255\n"
                           "50 for X = 1 to 20\n"
                           "60 if speed > 60 then backLED yaw * 255 / 359\n"
                           "70 if xpos * xpos + ypos * ypos > 40000 then locate 0,0\n"
                           "80 delay 5\n"
                           "90 next X\n"
                           "100 goto 10\n";
  vm::BallOptions options;
  options.loader = compiler::load;
  vm::Ball ball(options);
  ball.connect();
  ball.append_basic(vm::Area::Ram, as_bytes(text));
  ball.execute_basic(vm::Area::Ram, 10);
  const double start = processor_time();
  for (int minute = 0; minute < 60; ++minute) {
    ball.advance_to(ball.now() + 1min);
    ball.take_output();
  }
  fmt::print("an hour of a driving, blinking, sensor-reading program: {:.3f} s, {} lines\n",
             since(start), ball.machine().lines());
}

std::size_t heap_bytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Returns a program that fills its area.
std::string full_program() {
  std::string text;
  for (int line = 1;; ++line) {
    const auto next = fmt::format("{} A=A*{}+B/{}\n", line, line + 1, line + 2);
    if (text.size() + next.size() + 1 > 4096)
      return text + '\0';
    text += next;
  }
}

/// Measures the one-time cost of compiling a program to machine code.
void compile_times() {
  const auto measure = [](const char* what, const bytecode::Chunk& chunk) {
    double best = 1e9;
    for (int round = 0; round < 20; ++round) {
      const double start = processor_time();
      for (int i = 0; i < 10; ++i)
        vm::NativeCode::compile(chunk);
      best = std::min(best, since(start) / 10);
    }
    fmt::print("machine code of {}: {:.0f} us, {} instructions\n", what, best * 1e6,
               chunk.code.size());
  };
  measure("a typical program of 4 KB", compiler::load(bench::basic_program(4000)));
  measure("an area full of arithmetic", compiler::load(full_program()));
  std::string jumps;
  for (int line = 1; jumps.size() < 4080; ++line)
    jumps += fmt::format("{} goto {}\n", line, 1 + line * 7 % 300);
  measure("an area full of jumps", compiler::load(jumps));
}

void many_balls() {
  constexpr int count = 10'000;
  const auto before = heap_bytes();
  std::vector<std::unique_ptr<vm::Ball>> balls;
  vm::BallOptions options;
  options.loader = compiler::load;
  const std::string small = "10 goroll 90,100,1\n20 delay 1000\n30 goroll 0,0,0\n40 delay 500\n"
                            "50 A = A + 1\n60 print A;\n70 goto 10\n";
  const double start = processor_time();
  for (int i = 0; i < count; ++i) {
    options.seed = static_cast<std::uint64_t>(i);
    balls.push_back(std::make_unique<vm::Ball>(options));
    auto& ball = *balls.back();
    ball.connect();
    ball.append_basic(vm::Area::Ram, as_bytes(small));
    ball.execute_basic(vm::Area::Ram, 10);
  }
  for (int second = 0; second < 10; ++second)
    for (auto& ball : balls) {
      ball->advance_to(ball->now() + 1s);
      ball->take_output();
    }
  const auto each = (heap_bytes() - before) / count;
  fmt::print("{} balls side by side, 10 s of driving each: {:.2f} s, {} bytes a ball\n", count,
             since(start), each);
  balls.clear();

  const auto text = full_program();
  const auto empty = heap_bytes();
  auto ball = std::make_unique<vm::Ball>(options);
  ball->connect();
  ball->append_basic(vm::Area::Flash, as_bytes(text));
  ball->append_basic(vm::Area::Ram, as_bytes(text));
  ball->execute_basic(vm::Area::Ram, 1);
  ball->advance_to(ball->now() + 1s);
  fmt::print("a ball with RAM and flash full, running: {} bytes\n", heap_bytes() - empty);
}

} // namespace

int main(int argc, char** argv) {
  try {
    against_others(argc > 1 ? argv[1] : "tests/bench/kernels");
    compile_times();
    one_hour();
    many_balls();
  } catch (const std::exception& error) {
    fmt::print(stderr, "vm_bench: {}\n", error.what());
    return 1;
  }
}
