#include "vm/machine/native/engine.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace orb::vm {

namespace {

/// A program is compiled after it has run this many lines per instruction: compile time grows with
/// the program, so it must have earned more.
constexpr std::uint64_t runs_before_compiling = 200;
constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
/// Below this number of lines, switching to machine code costs more than it gains.
constexpr std::int64_t fewest_lines = 30;
constexpr std::int64_t lines_to_pay_a_change = 8;
/// A program that keeps leaving machine code returns to the loop. The balance counts lines gained.
constexpr std::int64_t greatest_loss = -10'000;

} // namespace

NativeEngine::NativeEngine(const NativeEngine& other)
    : when_(other.when_), shared_(other.shared_), only_interpreted_(other.only_interpreted_),
      threshold_(other.threshold_), compile_at_(other.compile_at_), gain_(other.gain_) {
  if (other.own_)
    compile_at_ = threshold_;
  else
    code_ = other.code_;
}

void NativeEngine::begin(std::size_t instructions) {
  code_ = nullptr;
  own_.reset();
  only_interpreted_ = {};
  gain_ = 0;
  if (when_ == Native::Off || (when_ == Native::Auto && !has_native_code()))
    threshold_ = never;
  else
    threshold_ = when_ == Native::On ? 0 : runs_before_compiling * instructions;
  compile_at_ = threshold_;
}

std::int64_t NativeEngine::until_asked(std::int64_t lines, std::uint64_t done,
                                       const bytecode::Chunk& chunk) {
  if (done >= compile_at_)
    compile(chunk);
  return static_cast<std::int64_t>(std::min(static_cast<std::uint64_t>(lines), compile_at_ - done));
}

void NativeEngine::compile(const bytecode::Chunk& chunk) {
  compile_at_ = never;
  code_ = shared_ ? shared_->find(chunk) : nullptr;
  if (code_)
    return;
  auto made = NativeCode::compile(chunk);
  if (made)
    own_ = *std::move(made);
  else
    only_interpreted_ = made.error();
  code_ = own_.get();
}

Exit NativeEngine::run(Core& core, const Engine& loop) {
  const bool pays = code_ && (when_ == Native::On || core.budget >= fewest_lines);
  return pays ? run_code(core, loop) : loop.run(core);
}

/// Runs machine code, and in the loop each single line that machine code does not handle.
Exit NativeEngine::run_code(Core& core, const Engine& loop) {
  while (true) {
    const std::int64_t before = core.budget;
    code_->run(core);
    if (core.budget == 0)
      return Exit::Budget;
    if (core.budget < NativeCode::longest_block)
      return loop.run(core);
    gain_ = std::min<std::int64_t>(0, gain_ + before - core.budget - lines_to_pay_a_change);
    if (when_ == Native::Auto && gain_ < greatest_loss) {
      code_ = nullptr;
      return loop.run(core);
    }
    const std::int64_t rest = core.budget - 1;
    core.allowed -= rest;
    core.budget = 1;
    const Exit exit = loop.run(core);
    core.allowed += rest;
    core.budget += rest;
    if (exit != Exit::Budget)
      return exit;
  }
}

} // namespace orb::vm
