#include "cli/many/board.h"

#include "base/text/utf8.h"
#include "cli/context/console.h"
#include "cli/terminal/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace orb::cli {
namespace {

constexpr auto pause = std::chrono::milliseconds{100}; // more frequent updates are not visible
constexpr std::size_t least_rows = 3;

} // namespace

Board::Board(const Context& context, const std::vector<RosterMember>& members)
    : context_(context), members_(members),
      animated_(!context.quiet && context.verbosity < 2 && can_animate()), texts_(members.size()) {
  for (const auto& member : members)
    name_width_ = std::max(name_width_, member.name.size());
}

Board::~Board() {
  clear();
}

void Board::show(std::size_t robot, std::string_view text) {
  const OutputTap::Closed streams; // taps print through the board
  const std::lock_guard lock(mutex_);
  const bool same_rows = texts_[robot].empty() == text.empty();
  texts_[robot] = text;
  const auto now = std::chrono::steady_clock::now();
  if (animated_ && (!same_rows || now - drawn_at_ >= pause)) {
    clear();
    draw();
    drawn_at_ = now;
  }
}

void Board::note(std::size_t robot, std::string_view message) {
  const OutputTap::Closed streams;
  const std::lock_guard lock(mutex_);
  clear();
  print_note(context_, fmt::format("{}: {}", members_[robot].name, message));
  draw();
}

void Board::print(std::size_t robot, std::string_view line) {
  const OutputTap::Closed streams;
  const std::lock_guard lock(mutex_);
  clear();
  print_out(fmt::format("{}: {}\n", members_[robot].name, line));
  draw();
}

void Board::clear() {
  if (drawn_ > 0) // print_err() would escape cursor movements
    std::fputs(fmt::format("\033[{}A\r\033[J", drawn_).c_str(), stderr);
  drawn_ = 0;
}

void Board::draw() {
  if (!animated_)
    return;
  const auto [rows, columns] = screen();
  const auto most = std::max(rows, least_rows) - 2;
  std::string text;
  std::size_t more = 0;
  for (std::size_t robot = 0; robot < texts_.size(); ++robot) {
    if (texts_[robot].empty())
      continue;
    if (drawn_ == most) {
      ++more;
      continue;
    }
    text += row(robot, columns) + "\n";
    ++drawn_;
  }
  if (more > 0) {
    text += fmt::format("and {} more\n", more);
    ++drawn_;
  }
  print_err(text);
}

/// A row cut to the screen's width: a wrapped row could not be drawn over.
std::string Board::row(std::size_t robot, std::size_t columns) const {
  const auto text = fmt::format("{:<{}}  {}", members_[robot].name, name_width_, texts_[robot]);
  if (text.size() < columns)
    return text;
  auto end = columns - 1;
  while (end > 0 && utf8_length(std::string_view(text).substr(end)) == 0)
    --end; // do not split a character
  return text.substr(0, end);
}

void Row::on_item(std::string_view name) {
  item_ = name;
  sending_since_.reset();
  board_.show(robot_, fmt::format("{:<10} {}", to_string(uploader::Stage::Greeting), item_));
}

void Row::on_status(const uploader::Status& status, Instant now) {
  if (status.stage == uploader::Stage::Sending && !sending_since_)
    sending_since_ = now;
  board_.show(robot_,
              fmt::format("{:<10} {} {} {}", to_string(status.stage), progress_bar(status), item_,
                          describe_progress(status, now - sending_since_.value_or(now))));
}

void Row::on_step(protocol::BleStep step,
                  const tl::expected<std::string, uploader::BleError>& found) {
  if (!found)
    return; // the verdict says it
  if (step == protocol::BleStep::Find)
    if (const auto open = found->rfind('('); open != found->npos && found->ends_with(" dBm)"))
      signal_ = found->substr(open + 1, found->size() - open - 2);
  board_.show(robot_, *found);
}

} // namespace orb::cli
