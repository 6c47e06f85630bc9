// Snapshots of the ball, so that going back does not run again from the start.

#include "debug/search.h"
#include "debug/timeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace orb::debug {
namespace {

/// When there are more, every second one is dropped.
constexpr std::size_t most_copies = 64;
/// Steps between a place from which the run went back and the snapshot kept before it.
constexpr std::uint64_t near_steps = 4096;

std::size_t bytes_of(const vm::Ball& ball) {
  const auto& core = ball.machine().core();
  return sizeof(vm::Ball) + core.code.capacity() * sizeof(vm::Code) +
         core.chunk.code.capacity() * sizeof(bytecode::Instruction) +
         core.chunk.lines.capacity() * sizeof(bytecode::Line) +
         core.registers.capacity() * sizeof(std::int32_t) +
         core.reciprocals.capacity() * sizeof(std::int64_t) +
         core.chunk.texts.capacity() * sizeof(std::string) +
         ball.basic_text(spec::Area::Ram).size() + ball.basic_text(spec::Area::Flash).size();
}

} // namespace

Timeline::Copy Timeline::copy() const {
  return {now(), std::make_unique<vm::Ball>(*ball_), commands_, events_, applied_};
}

void Timeline::restore(const Copy& copy) {
  ball_ = std::make_unique<vm::Ball>(*copy.ball);
  commands_ = copy.commands;
  events_ = copy.events;
  applied_ = copy.applied;
}

/// The last snapshot at or before `moment`.
const Timeline::Copy& Timeline::base_before(const Moment& moment) const {
  const auto after =
      std::upper_bound(copies_.begin() + 1, copies_.end(), moment,
                       [](const Moment& wanted, const Copy& one) { return wanted < one.at; });
  const auto& kept = *std::prev(after);
  return near_ && !(moment < near_->at) && kept.at < near_->at ? *near_ : kept;
}

void Timeline::keep_copy() {
  const auto& last = copies_.back();
  if (ball_->held() || !(last.at < now()) ||
      (step() - last.at.step < steps_apart_ && ball_->now() - last.at.at < time_apart_))
    return;
  copies_.push_back(copy());
  if (copies_.size() < most_copies)
    return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < copies_.size(); i += 2)
    std::swap(copies_[kept++], copies_[i]);
  copies_.resize(kept);
  steps_apart_ *= 2;
  time_apart_ *= 2;
}

/// Keeps a snapshot shortly before `moment`, so that further steps back are short.
void Timeline::copy_near(const Moment& moment) {
  if (near_ && near_->at < moment && moment.step - near_->at.step <= 2 * near_steps)
    return;
  const auto& base = base_before(moment);
  if (moment.step < base.at.step + near_steps)
    return;
  restore(base);
  Search search;
  search.bound = Moment{.step = moment.step - near_steps, .about_to = true};
  run(search);
  near_ = std::make_unique<Copy>(copy());
}

Timeline::Size Timeline::size() const {
  Size size{copies_.size() + (near_ ? 1 : 0), 0};
  size.bytes = size.copies * bytes_of(*ball_);
  return size;
}

} // namespace orb::debug
