#include "cli/terminal/progress_bar.h"
#include "cli/context/console.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::cli {
namespace {

using uploader::Stage;
using uploader::Status;

constexpr int bar_width = 20; // columns
/// Seconds; before that the bytes only fill the link's buffers and do not show its speed.
constexpr double least_seconds = 0.25;
constexpr std::string_view clear_line = "\r\033[K";

double fraction(const Status& status) {
  return status.bytes_total == 0
             ? 0.0
             : static_cast<double>(status.bytes_sent) / static_cast<double>(status.bytes_total);
}

} // namespace

bool can_animate() {
  return can_draw(Stream::Err);
}

std::string progress_bar(const Status& status) {
  const auto full = static_cast<std::size_t>(fraction(status) * bar_width);
  return fmt::format("[{}{}]", std::string(full, '#'), std::string(bar_width - full, '-'));
}

std::string describe_progress(const Status& status, Duration sending_for) {
  auto text = fmt::format("{}/{} bytes, {}/{} pieces", status.bytes_sent, status.bytes_total,
                          status.packets, std::max(status.packets, status.packets_total));
  const auto seconds = static_cast<double>(sending_for.count()) / 1e9;
  if (status.bytes_sent > 0 && seconds >= least_seconds) {
    const auto rate = static_cast<double>(status.bytes_sent) / seconds; // bytes/s
    text += fmt::format(", {:.1f} kB/s", rate / 1000);
    if (status.bytes_sent < status.bytes_total)
      text += fmt::format(", {:.1f} s left",
                          static_cast<double>(status.bytes_total - status.bytes_sent) / rate);
  }
  if (status.bytes_sent == 0 && status.expected > Duration{})
    text += fmt::format(", about {:.1f} s", static_cast<double>(status.expected.count()) / 1e9);
  return text;
}

ProgressBar::ProgressBar(const Context& context)
    : quiet_(context.quiet), animated_(!context.quiet && context.verbosity < 2 && can_animate()) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (drawn_)
    print_err(clear_line);
  drawn_ = false;
}

void ProgressBar::on_item(std::string_view name) {
  clear();
  name_ = name;
  sending_since_.reset();
  attempt_ = 1;
  told_quarter_ = 0;
}

void ProgressBar::on_status(const Status& status, Instant now) {
  if (status.attempt != attempt_) {
    attempt_ = status.attempt;
    sending_since_.reset();
    told_quarter_ = 0;
    clear();
    if (!quiet_)
      print_err(fmt::format("{}: an answer was lost or duplicated; sending it again from the start "
                            "(attempt {})\n",
                            name_, attempt_));
  }
  if (status.stage == Stage::Sending && !sending_since_)
    sending_since_ = now;
  if (animated_)
    draw(status, now);
  else if (!quiet_)
    print_line(status, now);
}

void ProgressBar::draw(const Status& status, Instant now) {
  if (status.stage == Stage::Done) {
    clear();
    return;
  }
  print_err(fmt::format("{}{} {} {}, {}", clear_line, name_, progress_bar(status),
                        describe_progress(status, now - sending_since_.value_or(now)),
                        to_string(status.stage)));
  drawn_ = true;
}

void ProgressBar::print_line(const Status& status, Instant now) {
  const auto quarter = static_cast<int>(fraction(status) * 4);
  const auto sending = status.stage == Stage::Sending || status.stage == Stage::Confirming;
  if (!sending || quarter <= told_quarter_)
    return;
  told_quarter_ = quarter;
  print_err(fmt::format("{}: {}\n", name_,
                        describe_progress(status, now - sending_since_.value_or(now))));
}

CountBar::CountBar(const Context& context, std::string_view noun)
    : noun_(noun), animated_(!context.quiet && can_animate()) {}

CountBar::~CountBar() {
  if (drawn_)
    print_err(clear_line);
}

void CountBar::show(std::uint64_t done, std::uint64_t all) {
  using namespace std::chrono;
  constexpr auto pause = milliseconds{100}; // more frequent updates are not visible
  const auto now = steady_clock::now();
  if (!animated_ || all == 0 || now - drawn_at_ < pause)
    return;
  drawn_at_ = now;
  drawn_ = true;
  const auto full = static_cast<std::size_t>(done * bar_width / all);
  auto text = fmt::format("{}[{}{}] {} of {} {}", clear_line, std::string(full, '#'),
                          std::string(bar_width - full, '-'), done, all, noun_);
  const auto seconds = duration<double>(now - start_).count();
  if (done > 0 && done < all && seconds >= least_seconds)
    text += fmt::format(", {:.0f} s left",
                        seconds * static_cast<double>(all - done) / static_cast<double>(done));
  print_err(text);
}

} // namespace orb::cli
