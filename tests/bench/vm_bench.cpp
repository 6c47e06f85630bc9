// The machine against `luajit -joff` on the same algorithms: tests/bench/kernels/NAME.bas and .lua.
// Prints the table of docs/performance.md. Run it through ./dev bench.

#include "compiler/load.h"
#include "vm/ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
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
constexpr int rounds = 7; // the best of so many counts: what disturbs only ever adds

/// Processor time in seconds, as luajit's os.clock() counts it: other programs do not disturb it.
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

/// Keeps what a program prints.
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

/// Runs a whole ball, as `orb run` does, and times it from the start of the program to its end.
Measured run_basic(const std::string& text, std::uint32_t lines_per_second, vm::Dispatch dispatch) {
  Printed printed;
  vm::BallOptions options;
  options.loader = compiler::load;
  options.observer = &printed;
  options.lines_per_second = lines_per_second;
  options.dispatch = dispatch;
  vm::Ball ball(options);
  ball.connect();
  ball.append_basic(vm::Area::Ram, as_bytes(text));
  const double start = processor_time();
  ball.execute_basic(vm::Area::Ram, 10);
  while (ball.basic_running())
    ball.advance_to(ball.now() + 1h);
  return {since(start), ball.machine().lines(), printed.text};
}

/// Runs a script, which is asked to time itself, in the interpreter of LuaJIT.
Measured run_lua(const std::string& path) {
  const auto command =
      fmt::format("luajit -joff -e \"local t = os.clock(); dofile('{}'); "
                  "print(string.format('%.9f', os.clock() - t))\"",
                  path);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe)
    throw std::runtime_error("cannot run luajit");
  std::string out;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()))
    out += buffer.data();
  const auto split = out.find('\n');
  if (split == std::string::npos)
    throw std::runtime_error("luajit said: " + out);
  return {std::strtod(out.c_str() + split, nullptr), 0, out.substr(0, split + 1)};
}

void against_lua(const std::string& folder) {
  struct Kernel {
    const char* name;
    const char* what;
  };
  constexpr std::array kernels{
      Kernel{"nested", "nested loops, arithmetic"}, Kernel{"collatz", "branches, division"},
      Kernel{"calls", "subroutines"}, Kernel{"sort", "a sort through Z"}};
  constexpr std::array<std::uint32_t, 2> speeds{3'000'000, 3000};
  fmt::print("{:<26}{:>10}{:>14}{:>10}{:>12}{:>9}{:>9}\n", "kernel", "lines", "luajit -joff",
             "orb 3M/s", "orb 3000/s", "3M/s", "3000/s");
  std::array<double, 2> product{1, 1};
  for (const auto& kernel : kernels) {
    const auto path = folder + "/" + kernel.name;
    const auto text = read_all(path + ".bas");
    double lua = 1e9;
    std::array<double, 2> orb{1e9, 1e9};
    std::uint64_t lines = 0;
    for (int round = 0; round < rounds; ++round) {
      const auto theirs = run_lua(path + ".lua");
      lua = std::min(lua, theirs.seconds);
      for (std::size_t i = 0; i < speeds.size(); ++i) {
        const auto ours = run_basic(text, speeds[i], vm::Dispatch::Threaded);
        if (ours.printed != theirs.printed)
          throw std::runtime_error(fmt::format("{}: orb prints {}, luajit {}", kernel.name,
                                               ours.printed, theirs.printed));
        orb[i] = std::min(orb[i], ours.seconds);
        lines = ours.lines;
      }
    }
    fmt::print("{:<26}{:>10}{:>9.1f} ms{:>9.1f} ms{:>9.1f} ms{:>8.2f}x{:>8.2f}x\n", kernel.what,
               lines, lua * 1e3, orb[0] * 1e3, orb[1] * 1e3, lua / orb[0], lua / orb[1]);
    product[0] *= lua / orb[0];
    product[1] *= lua / orb[1];
  }
  fmt::print("{:<26}{:>10}{:>12}{:>12}{:>12}{:>8.2f}x{:>8.2f}x\n\n", "geometric mean", "", "", "",
             "", std::pow(product[0], 1.0 / kernels.size()),
             std::pow(product[1], 1.0 / kernels.size()));
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

/// A program that fills its area.
std::string full_program() {
  std::string text;
  for (int line = 1;; ++line) {
    const auto next = fmt::format("{} A=A*{}+B/{}\n", line, line + 1, line + 2);
    if (text.size() + next.size() + 1 > 4096)
      return text + '\0';
    text += next;
  }
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
    against_lua(argc > 1 ? argv[1] : "tests/bench/kernels");
    one_hour();
    many_balls();
  } catch (const std::exception& error) {
    fmt::print(stderr, "vm_bench: {}\n", error.what());
    return 1;
  }
}
