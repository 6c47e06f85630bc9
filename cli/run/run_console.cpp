#include "cli/run/run_console.h"
#include "cli/context/console.h"

#include "base/text/text.h"
#include "disk/disk.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <limits>
#include <thread>

namespace orb::cli {
namespace {

/// True if reading standard input would not block.
bool input_is_there() {
  return std::cin.rdbuf()->in_avail() > 0 || input_waits();
}

} // namespace

Console::Console(const RunOptions& options, const std::vector<run::Input>& inputs)
    : options_(options) {
  if (const auto format = options.format())
    trace_.emplace(*format,
                   options.run.trace_lines ? report::TraceLines::Keep : report::TraceLines::Leave,
                   inputs, [this](std::string_view text) { put(text); });
}

void Console::on_event(Duration t, const vm::Event& event) {
  if (const auto* print = std::get_if<vm::event::Print>(&event);
      print != nullptr && (!trace_ || !options_.trace_out.empty()))
    this->print(print->text);
  if (const auto* drive = std::get_if<vm::event::Drive>(&event);
      drive != nullptr && drive->roll.speed > 0)
    speeds_ = {std::min(speeds_.slowest, drive->roll.speed),
               std::max(speeds_.fastest, drive->roll.speed)};
  if (trace_)
    trace_->add(t, event);
}

void Console::on_fault(Duration t, const run::ProgramError& fault) {
  if (trace_)
    trace_->add(t, fault);
}

void Console::on_time(Duration t) {
  if (options_.realtime)
    std::this_thread::sleep_until(start_ + t);
}

bool Console::has_more_numbers() const {
  return options_.input == from_stdin && no_number_.empty() && std::cin.good();
}

std::optional<std::int32_t> Console::ask_number() {
  const bool robot_waits = !options_.port.port.empty();
  std::string word;
  while (has_more_numbers() && (!robot_waits || input_is_there()) && std::cin >> word) {
    const auto digits = std::string_view(word).substr(word.starts_with('+') ? 1 : 0);
    if (const auto value = parse_number<std::int32_t>(digits))
      return value;
    const auto message = fmt::format("`{}` is not a whole number from {} to {}, which `input` "
                                     "takes",
                                     word, std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max());
    if (!is_terminal(Stream::In))
      no_number_ = "on standard input, " + message;
    else
      print_err(message + "; try again\n");
  }
  return std::nullopt;
}

tl::expected<void, IoError> Console::finish(const run::Ending& ending) {
  if (trace_)
    trace_->finish(ending);
  return options_.trace_out.empty() ? tl::expected<void, IoError>()
                                    : disk::write(options_.trace_out, as_bytes(text_));
}

void Console::print(std::string_view text) {
  if (lost_)
    return;
  try {
    print_out(text);
  } catch (const OutputError& error) {
    if (!on_lost_)
      throw;
    lost_ = error;
    on_lost_();
  }
}

void Console::put(std::string_view text) {
  if (options_.trace_out.empty())
    print(text);
  else
    text_ += text;
}

} // namespace orb::cli
