#include "cli/ball/served_record.h"

#include "cli/context/context.h"
#include "disk/disk.h"
#include "report/journey.h"
#include "report/page.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace orb::cli {
namespace {

constexpr std::string_view page_title = "orb ball";

} // namespace

/// Watches one ball.
class ServedRecord::Seat final : public serve::Spectator {
public:
  Seat(ServedRecord& record, int index) : record_(record), name_(std::to_string(index + 1)) {
    const auto& options = record.options_;
    if (options.trace)
      trace_.emplace(
          *options.trace, report::TraceLines::Leave,
          [this](std::string_view text) { record_.put(text); }, report::LinePlaces{},
          report::TraceOf{options.count == 1 ? "" : name_});
    if (options.report.empty())
      return;
    journey_.emplace().set_robot(options.robot);
    if (options.course)
      journey_->set_course(*options.course);
    for (const auto& event : options.stimulus)
      if (const auto* wall = std::get_if<vm::Wall>(&event.stimulus))
        journey_->add_wall(*wall);
  }

  void on_begin(Instant at, const vm::Ball& ball) override {
    ball_ = &ball;
    on_event(at, vm::event::Position{ball.body().pose()});
  }
  void on_event(Instant at, const vm::Event& event) override {
    const auto t = at.time_since_epoch();
    if (const auto* end = std::get_if<vm::event::End>(&event))
      lines_ += end->lines;
    if (trace_)
      trace_->add(t, event);
    if (!journey_)
      return;
    journey_->add(t, event);
    if (ball_ != nullptr)
      journey_->sample(t, ball_->body());
  }
  void on_end(Instant at) override {
    const auto t = at.time_since_epoch();
    if (trace_)
      trace_->finish(t, "end", lines_);
    if (journey_)
      journey_->finish(t, "end", "ended");
    ball_ = nullptr;
  }
  bool has_enough() const override { return record_.lost_.has_value(); }

  report::RoomRun run() const { return {name_, &*journey_}; }

private:
  ServedRecord& record_;
  std::string name_;
  std::optional<report::TraceWriter> trace_;
  std::optional<report::Journey> journey_;
  const vm::Ball* ball_ = nullptr;
  std::uint64_t lines_ = 0;
};

ServedRecord::ServedRecord(RecordOptions options) : options_(std::move(options)) {}
ServedRecord::~ServedRecord() = default;

tl::expected<void, IoError> ServedRecord::open() {
  if (options_.trace && !options_.trace_out.empty()) {
    file_.open(disk::as_path(options_.trace_out));
    if (!file_)
      return tl::unexpected(IoError{fmt::format(
          "cannot write {}: {}", disk::display_name(options_.trace_out), std::strerror(errno))});
  }
  if (options_.trace && options_.count > 1)
    put(report::room_trace_head(*options_.trace));
  return {};
}

serve::Spectator* ServedRecord::watch(int index) {
  if (!options_.trace && options_.report.empty())
    return nullptr;
  return seats_.emplace_back(std::make_unique<Seat>(*this, index)).get();
}

/// Writes at once: a ball may be served for days.
void ServedRecord::put(std::string_view text) {
  if (!options_.trace_out.empty()) {
    if (!broken_ && !(file_ << text << std::flush))
      broken_ = IoError{fmt::format("cannot write {}: {}", disk::display_name(options_.trace_out),
                                    std::strerror(errno))};
    return;
  }
  if (lost_)
    return;
  try {
    print_out(text);
  } catch (const OutputError& error) { // keeps the balls before reporting anything
    lost_ = error;
  }
}

tl::expected<void, IoError> ServedRecord::finish() {
  if (!options_.report.empty()) {
    std::vector<report::RoomRun> runs;
    for (const auto& seat : seats_)
      runs.push_back(seat->run());
    const auto page = runs.size() == 1 ? report::report_page(*runs.front().journey, page_title)
                                       : report::room_page(runs, page_title);
    if (auto written = disk::write(options_.report, as_bytes(page)); !written)
      return written;
  }
  if (broken_)
    return tl::unexpected(*broken_);
  return {};
}

} // namespace orb::cli
