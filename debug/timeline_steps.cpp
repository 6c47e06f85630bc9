// What the ball asks before each step, and tells on its way.

#include "debug/search.h"
#include "debug/timeline.h"

#include <algorithm>
#include <utility>

namespace orb::debug {
namespace {

constexpr std::int64_t lines_at_once = 1 << 20;

} // namespace

std::int64_t Timeline::lines() {
  if (!may_begin(Next::Line))
    return 0;
  if (search_->watch != nullptr && search_->watch->wants_lines())
    return 1;
  search_->questions += questions_between_looks / 64; // many lines run now
  if (!search_->bound)
    return lines_at_once;
  return std::min(lines_at_once, static_cast<std::int64_t>(search_->bound->step - step()));
}

bool Timeline::command() {
  if (!may_begin(Next::Command))
    return false;
  ++commands_;
  return true;
}

bool Timeline::may_begin(Next what) {
  const bool is_line = what == Next::Line;
  if (search_ == nullptr)
    return false;
  auto& search = *search_;
  if (search.gather_to && search.hit)
    resolve(is_line ? ball_->machine().now() : ball_->now(), At::NextStep);
  if (search.bound && step() >= search.bound->step) {
    search.at_bound = true;
    return false;
  }
  if (search.skip == step())
    return true;
  if (search.closed || search.hit || search.unwanted())
    return false;
  auto* watch = search.watch;
  if (watch == nullptr || !(is_line ? watch->wants_lines() && watch->line() : watch->command()))
    return true;
  if (search.gather_to) {
    search.note({.step = step(), .about_to = true});
    return true;
  }
  search.found = true;
  return false;
}

void Timeline::on_event(Instant at, const vm::Event& event) {
  if (search_ == nullptr)
    return;
  if (journey_ != nullptr) {
    journey_->add(at - start_, event);
    journey_->sample(at - start_, ball_->body());
  }
  if (++events_ > told_) {
    told_ = events_;
    audience_.on_event(at - start_, event);
  }
  if (search_->watch != nullptr && search_->watch->event(event))
    hit(at);
  if (search_->unwanted())
    ball_->interrupt();
}

void Timeline::on_step(Instant at, const vm::Body&) {
  if (search_ == nullptr)
    return;
  if (search_->watch != nullptr && search_->watch->motion(at - start_))
    hit(at);
  if (search_->unwanted())
    ball_->interrupt();
}

/// Something between two steps was found. If a program is running, the run stops before its next
/// line, otherwise at this instant.
void Timeline::hit(Instant at) {
  auto& search = *search_;
  if (search.gather_to) {
    const bool waits = !ball_->basic_running() || ball_->machine().waits();
    if (search.hit && *search.hit < at && waits)
      search.note({.step = step(), .at = *search.hit});
    search.hit = at;
  } else if (!search.hit) {
    search.hit = at;
    ball_->interrupt();
  }
}

/// A find whose place was open: at `at` the next step begins, or the search ends.
void Timeline::resolve(Instant at, At what) {
  auto& search = *search_;
  const auto found = *std::exchange(search.hit, std::nullopt);
  if (at > found || (what == At::End && (!ball_->basic_running() || ball_->machine().waits())))
    search.note({.step = step(), .at = found});
  else
    search.note({.step = step(), .about_to = true});
}

} // namespace orb::debug
