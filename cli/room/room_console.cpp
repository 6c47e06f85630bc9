#include "cli/room/room_console.h"

#include "disk/disk.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::cli {
namespace {

bool has_places(const run::RoomBall& ball) {
  const auto* first = run::first_with_program(ball.inputs);
  return first != nullptr && first->program->compiled != nullptr;
}

} // namespace

/// Listens to one ball.
class RoomConsole::Ear final : public run::Listener {
public:
  Ear(RoomConsole& console, const run::RoomBall& ball, std::size_t rank, bool sources)
      : console_(console), name_(ball.name), rank_(rank) {
    const auto lines =
        console.options_.run.trace_lines ? report::TraceLines::Keep : report::TraceLines::Leave;
    if (console.format_)
      trace_.emplace(
          *console.format_, lines, ball.inputs,
          [this](std::string_view text) {
            console_.tell(t_, rank_, std::string(text), From::Trace);
          },
          report::TraceOf{name_, sources});
  }

  void on_event(Duration t, const vm::Event& event) override {
    t_ = t;
    if (const auto* print = std::get_if<vm::event::Print>(&event); print && console_.prints_)
      take(print->text);
    if (trace_)
      trace_->add(t, event);
  }
  void on_fault(Duration t, const run::ProgramError& fault) override {
    t_ = t;
    if (trace_)
      trace_->add(t, fault);
  }
  void on_time(Duration) override {
    if (rank_ + 1 == console_.ears_.size()) // the last in order: the others have reported already
      console_.flush();
  }
  void finish(const run::Ending& ending) {
    if (!line_.empty())
      take("\n");
    t_ = ending.lasted;
    if (trace_)
      trace_->finish(ending);
  }

private:
  void take(std::string_view text) {
    line_ += text;
    for (std::size_t end = 0; (end = line_.find('\n')) != std::string::npos;
         line_.erase(0, end + 1))
      console_.tell(t_, rank_, fmt::format("{}: {}", name_, line_.substr(0, end + 1)),
                    From::Program);
  }

  RoomConsole& console_;
  const std::string& name_;
  std::size_t rank_;
  std::optional<run::Trace> trace_;
  Duration t_{};
  std::string line_; ///< printed text without its line end yet
};

RoomConsole::RoomConsole(const RunOptions& options, std::vector<const run::RoomBall*> balls)
    : options_(options), format_(options.format()),
      prints_(!format_ || !options.trace_out.empty()) {
  const bool sources =
      std::any_of(balls.begin(), balls.end(), [](const auto* ball) { return has_places(*ball); });
  for (const auto* ball : balls) {
    const auto rank = std::count_if(balls.begin(), balls.end(),
                                    [&](const auto* other) { return other->name < ball->name; });
    ears_.push_back(std::make_unique<Ear>(*this, *ball, static_cast<std::size_t>(rank), sources));
  }
  if (format_)
    put({{}, 0, report::room_trace_head(*format_, sources), From::Trace});
}

RoomConsole::~RoomConsole() = default;

run::Listener& RoomConsole::ear(std::size_t ball) {
  return *ears_[ball];
}

tl::expected<void, IoError> RoomConsole::finish(const std::vector<run::Ending>& endings) {
  flush();
  for (std::size_t i = 0; i < endings.size(); ++i)
    ears_[i]->finish(endings[i]);
  flush();
  return options_.trace_out.empty() ? tl::expected<void, IoError>()
                                    : disk::write(options_.trace_out, as_bytes(text_));
}

void RoomConsole::tell(Duration t, std::size_t rank, std::string text, From from) {
  waiting_.push_back({t, rank, std::move(text), from});
}

void RoomConsole::flush() {
  std::stable_sort(waiting_.begin(), waiting_.end(),
                   [](const PendingLine& a, const PendingLine& b) {
                     return std::pair(a.t, a.rank) < std::pair(b.t, b.rank);
                   });
  for (const auto& line : waiting_)
    put(line);
  waiting_.clear();
}

void RoomConsole::put(const PendingLine& line) {
  if (line.from == From::Trace && !options_.trace_out.empty())
    text_ += line.text;
  else
    print_out(line.text);
}

} // namespace orb::cli
